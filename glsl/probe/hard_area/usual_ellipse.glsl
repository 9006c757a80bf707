// An ellipse light as it is usually written, after Heitz and Hill 2017: the cubic of its cone, of which the roots come in
// closed form, and beyond the horizon a sphere of the same form factor in its place.
#ifndef PROBE_HARD_AREA_USUAL_ELLIPSE_GLSL
#define PROBE_HARD_AREA_USUAL_ELLIPSE_GLSL

#include "lib/math.glsl"

// Of x³ + c.z x² + c.y x + c.x, from the largest down.
vec3 usual_roots(vec3 c) {
    float p = (c.z * c.z - 3.0 * c.y) / 9.0;
    float h = (9.0 * c.z * c.y - 27.0 * c.x - 2.0 * c.z * c.z * c.z) / 54.0;
    float angle = atan(sqrt(p * p * p - h * h), h) / 3.0;
    return 2.0 * sqrt(p) * cos(vec3(angle, angle - 2.0 * PI / 3.0, angle + 2.0 * PI / 3.0)) - c.z / 3.0;
}

// Lagarde and de Rousiers 2014, of a sphere of sin² `size` at this cosine.
float usual_sphere(float cosine, float size) {
    if (cosine * cosine > size) return size * max(cosine, 0.0);
    float sine = sqrt(1.0 - cosine * cosine);
    float x = sqrt(1.0 / size - 1.0);
    float y = -x * cosine / sine;
    float s = sine * sqrt(1.0 - y * y);
    return INV_PI * ((cosine * acos(y) - x * s) * size + atan(s / x));
}

float usual_ellipse(HardProbeRow r) {
    vec3 x = normalize(r.b.xyz), y = normalize(r.c.xyz);
    vec3 z = cross(x, y);
    z = dot(z, r.a.xyz) < 0.0 ? -z : z;
    float d = dot(z, r.a.xyz);
    vec2 at = vec2(dot(x, r.a.xyz), dot(y, r.a.xyz)) / d;
    vec2 inverse2 = d * d / vec2(dot(r.b.xyz, r.b.xyz), dot(r.c.xyz, r.c.xyz));
    vec2 stretch = inverse2 * (1.0 + at * at);
    float product = inverse2.x * inverse2.y;
    vec3 roots = usual_roots(vec3(
        product, product * (1.0 + dot(at, at)) - inverse2.x - inverse2.y, 1.0 - stretch.x - stretch.y));
    vec2 lean = inverse2 * at / (inverse2 - roots.z);
    vec3 axis = normalize(lean.x * x + lean.y * y + z);
    vec2 size2 = -roots.z / roots.xy;
    float size = sqrt(size2.x * size2.y / ((1.0 + size2.x) * (1.0 + size2.y)));
    return usual_sphere(axis.z, size);
}

#endif
