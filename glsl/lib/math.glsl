// The only file with a constant of nature, and the few functions that GLSL lacks or leaves imprecise.
#ifndef LIB_MATH_GLSL
#define LIB_MATH_GLSL

const float PI = 3.14159265358979324;
const float INV_PI = 0.318309886183790672;
const float RADIANS_PER_DEGREE = 0.0174532925199432958;

// Guards against 0/0, never a bias: TINY is below any product of squared lengths that a picture holds and above the
// smallest normal float, 1.2e-38; MIN_COSINE is below any cosine that float32 directions can tell from 0, and a
// microfacet peak divided by it twice is still finite.
const float TINY = 1e-30;
const float MIN_COSINE = 1e-15;

float sqr(float x) { return x * x; }
vec3 sqr(vec3 x) { return x * x; }

float greatest(vec3 x) { return max(x.x, max(x.y, x.z)); }

// Not pow(): Vulkan grants it the errors of exp2 and log2 together, and software drivers take both from polynomials.
float pow5(float x) { return sqr(sqr(x)) * x; }

// 1 − (1 − x)⁵ in [0, 1], expanded: the subtraction would lose x where a direction grazes.
float schlick_complement(float x) { return x * (5.0 - x * (10.0 - x * (10.0 - x * (5.0 - x)))); }

// Rec.709, of scene-linear RGB.
float luminance(vec3 color) { return dot(color, vec3(0.212671, 0.715160, 0.072169)); }

// From a at t = 0 to b at t = 1 as a sum of positive terms. Not mix(): drivers take a + t (b − a) for it, which leaves
// 7e-6 of relative error in a clearcoat's alpha.
float lerp(float a, float b, float t) { return a * (1.0 - t) + b * t; }
vec3 lerp(vec3 a, vec3 b, float t) { return a * (1.0 - t) + b * t; }

// isnan() by bits: a compiler may take for granted that there are no such numbers, and answer no.
bvec3 no_number(vec3 v) {
    return greaterThan(floatBitsToUint(v) & 0x7fffffffu, uvec3(0x7f800000u));
}

#endif
