// Point lights: distance law.
#ifndef LIB_LIGHT_GLSL
#define LIB_LIGHT_GLSL

// (1 − (d/range)⁴)²₊ / max(d², floor): radiant intensity to irradiance at normal incidence. Without a range
// inverse_range2 is 0 and the window 1.
float falloff(float d2, float inverse_range2, float d2_floor) {
    float x = d2 * inverse_range2;
    float window = max(1.0 - x * x, 0.0);
    return window * window / max(d2, d2_floor);
}

#endif
