// The only file with a constant of nature, and the few functions that GLSL lacks or leaves imprecise.
#ifndef LIB_MATH_GLSL
#define LIB_MATH_GLSL

const float PI = 3.14159265358979324;
const float INV_PI = 0.318309886183790672;
const float LN_2 = 0.693147180559945309;
const float RADIANS_PER_DEGREE = 0.0174532925199432958;

// Guards against 0/0, never a bias: TINY is below any product of squared lengths that a picture holds and above the
// smallest normal float, 1.2e-38; MIN_COSINE is below any cosine that float32 directions can tell from 0, and a
// microfacet peak divided by it twice is still finite.
const float TINY = 1e-30;
const float MIN_COSINE = 1e-15;

float sqr(float x) { return x * x; }
vec3 sqr(vec3 x) { return x * x; }

// Not pow(): Vulkan grants it the error of exp2 and log2 together, 2e-5 relative on Mesa's lavapipe.
float pow5(float x) { return sqr(sqr(x)) * x; }

float safe_sqrt(float x) { return sqrt(max(x, 0.0)); }

// Rec.709, of scene-linear RGB.
float luminance(vec3 color) { return dot(color, vec3(0.212671, 0.715160, 0.072169)); }

// ln x of a normal x > 0 to 2e-7 relative. Vulkan bounds log() by 3 ulp *outside* [0.5, 2] only, and drivers without
// the instruction fall short of that. With x = m·2^e, m in [√½, √2): ln m = 2 artanh((m−1)/(m+1)).
float log_accurate(float x) {
    int bits = floatBitsToInt(x);
    int exponent = (bits - 0x3f3504f3) >> 23;
    float m = intBitsToFloat(bits - (exponent << 23));
    float s = (m - 1.0) / (m + 1.0);
    float z = s * s;
    float series = 1.0 + z * (1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0))));
    return float(exponent) * LN_2 + 2.0 * s * series;
}

#endif
