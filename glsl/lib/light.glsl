// Point lights: distance law, and where radiance ends.
#ifndef LIB_LIGHT_GLSL
#define LIB_LIGHT_GLSL

// Intensities end at 1e18, so a single light cannot overflow; the sum of a million can, and infinity is no radiance.
const vec3 MAX_RADIANCE = vec3(1e30);

// (1 − (d/range)⁴)²₊ / max(d², floor): radiant intensity to irradiance at normal incidence. Without a range
// inverse_range2 is 0 and the window 1.
float falloff(float d2, float inverse_range2, float d2_floor) {
    float x = d2 * inverse_range2;
    float window = max(1.0 - x * x, 0.0);
    return window * window / max(d2, d2_floor);
}

#endif
