// The arc tangent of area lights. Vulkan grants atan 4,096 ulp and sin, cos 2⁻¹¹; these are polynomials, so that every
// device has the error that the tests measure.
#ifndef LIB_AREA_ANGLE_GLSL
#define LIB_AREA_ANGLE_GLSL

#include "lib/math.glsl"

const float HALF_PI = 1.57079632679489662;

// Below the product of any two lengths that a scene holds, and its inverse square root is finite.
const float LEAST_SQUARE = 1e-37;

float cross_2d(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// (atan(t)/t − 1)/t² for s = t² in [0, 1], fitted to the least relative error of atan(t): 1.7e-8, in float32 9e-8.
float arc_tangent_tail(float s) {
    float p = -0.0163679142 + s * 0.0029206886;
    p = 0.0432118364 + s * p;
    p = -0.0755221248 + s * p;
    p = 0.106660038 + s * p;
    p = -0.142110556 + s * p;
    p = 0.199937731 + s * p;
    return -0.333331525 + s * p;
}

// θ/|sin θ| for θ in [0, π] given by multiples of its cosine and sine: `lead` stands for the leading 1 of the series of
// small angles, which a caller may want without (form_factor_term). By sine over cosine in the first and last quarter,
// by cosine over sine between, so that no sine is ever taken from a cosine.
float angle_over_sine(float cosine, float sine, float inverse_sine, float lead) {
    float big = max(max(abs(cosine), sine), LEAST_SQUARE);
    float t = min(abs(cosine), sine) / big;
    bool steep = sine > abs(cosine);
    float begin = steep ? HALF_PI : cosine < 0.0 ? PI : 0.0;
    float factor = steep ? t : 1.0;
    factor = (cosine < 0.0) == steep ? factor : -factor;
    float s = t * t;
    return begin * inverse_sine + factor * (lead + s * arc_tangent_tail(s)) / big;
}

// Angle of (x, y) in [−π, π] to 2e-7; 0 for (0, 0).
float angle_of(float y, float x) {
    float big = max(abs(x), abs(y));
    float t = min(abs(x), abs(y)) / max(big, LEAST_SQUARE);
    float s = t * t;
    float angle = t + t * s * arc_tangent_tail(s);
    angle = abs(y) > abs(x) ? HALF_PI - angle : angle;
    angle = x < 0.0 ? PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}

// cos and sin of an angle in [−π/2, π/2] to 1e-7.
vec2 cos_sin(float angle) {
    float half_angle = 0.5 * angle;
    float s = half_angle * half_angle;
    float tail = s * (-0.166666546 + s * (0.00833216076 - s * 0.00019515283));
    float sine = half_angle + half_angle * tail;
    return vec2(1.0 - 2.0 * sine * sine, 2.0 * sine * sqrt(1.0 - sine * sine));
}

// artanh(y)/y for y in [0, 1), given 1 − y² which the caller has without cancellation. log is exact to 3 ulp only from 2
// on: below, a polynomial of relative error 3e-8.
float artanh_over(float y, float one_minus_y2) {
    float s = y * y;
    float p = -0.0290110812 + s * 0.272438156;
    p = 0.143394079 + s * p;
    p = 0.138652174 + s * p;
    p = 0.200246393 + s * p;
    p = 0.333328584 + s * p;
    float far = log((1.0 + y) * inversesqrt(max(one_minus_y2, LEAST_SQUARE))) / max(y, 0.5);
    return y < 0.6 ? 1.0 + s * p : far;
}

#endif
