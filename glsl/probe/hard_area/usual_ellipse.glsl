// An ellipse light as it is usually written, after Heitz and Hill 2017: the cubic of its cone, solved as in the shader
// that they published, and beyond the horizon a sphere of the same form factor in its place.
#ifndef PROBE_HARD_AREA_USUAL_ELLIPSE_GLSL
#define PROBE_HARD_AREA_USUAL_ELLIPSE_GLSL

#include "lib/math.glsl"

// The largest and the smallest root of y³ + 3 p y + q, from p, −q and the root of −4 p³ − q²: all three are real.
vec2 usual_outer_roots(float p, float lead, float sine) {
    float angle = atan(sine, lead) / 3.0;
    return 2.0 * sqrt(-p) * cos(vec2(angle, angle + 2.0 * PI / 3.0));
}

// Of x³ + 3 b x² + 3 c x + d, the least last. Blinn 2007, «How to Solve a Cubic Equation», part 5: the root farthest from
// 0 by the equation, the nearest by its reverse, which is for −d/x, and the third from both: by one angle for all three
// the small ones would be differences of large numbers.
vec3 usual_roots(float b, float c, float d) {
    vec3 hessian = vec3(c - b * b, d - b * c, b * d - c * c);
    float sine = sqrt(4.0 * hessian.x * hessian.z - hessian.y * hessian.y);
    vec2 ends = usual_outer_roots(hessian.x, 2.0 * b * hessian.x - hessian.y, sine);
    float far = (ends.x + ends.y > 2.0 * b ? ends.x : ends.y) - b;
    ends = usual_outer_roots(hessian.z, d * hessian.y - 2.0 * c * hessian.z, d * sine);
    float near = -d / ((ends.x + ends.y < 2.0 * c ? ends.x : ends.y) + c);
    float sum = far + near, product = far * near;
    float middle = -(c * sum + b * product) / (c + b * sum);
    if (far < middle && far < near) return vec3(middle, near, far);
    return middle < near ? vec3(far, near, middle) : vec3(far, middle, near);
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
    float middle = product * (1.0 + dot(at, at)) - inverse2.x - inverse2.y;
    vec3 roots = usual_roots((1.0 - stretch.x - stretch.y) / 3.0, middle / 3.0, product);
    vec2 lean = inverse2 * at / (inverse2 - roots.z);
    vec3 axis = normalize(lean.x * x + lean.y * y + z);
    vec2 size2 = -roots.z / roots.xy;
    float size = sqrt(size2.x * size2.y / ((1.0 + size2.x) * (1.0 + size2.y)));
    return usual_sphere(axis.z, size);
}

#endif
