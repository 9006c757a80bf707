// Fresnel reflectances for unpolarised light as functions of C = (wi·h)² = |wi + wo|²/4.
#ifndef LIB_BSDF_FRESNEL_GLSL
#define LIB_BSDF_FRESNEL_GLSL

#include "lib/math.glsl"

// Dielectric, air to eta, given eta² − 1. With t² = eta² − sin² = eta² − 1 + C, the amplitudes are
//   r_s = (c − t)/(c + t) = (1 − eta²)/(c + t)²,   r_p = r_s (ct − sin²)/(ct + sin²),
// so nothing cancels as eta → 1, and (r_s² + r_p²)/2 needs one root, p = ct, and one division. Beyond total reflection
// t is clamped to 0 and the quotient, which then exceeds 1, to 1.
float fresnel_dielectric(float eta2_minus_1, float cos2) {
    float t2 = max(eta2_minus_1 + cos2, 0.0);
    float sin2 = 1.0 - cos2;
    float p2 = cos2 * t2;
    float p = sqrt(p2);
    float denominator = sqr((cos2 + t2 + 2.0 * p) * (p + sin2));
    return min(sqr(eta2_minus_1) * (p2 + sqr(sin2)) / max(denominator, TINY), 1.0);
}

struct Conductor {
    vec3 real;        // eta² − k² − 1
    vec3 imaginary2;  // (2 eta·k)²
    vec3 difference2; // |(eta + ik)² − 1|²
};

// An index of 0 reflects all at every angle, and so does any imaginary one: the substitute keeps 0/0 out of the loop.
Conductor conductor_setup(vec3 eta, vec3 k) {
    k = mix(k, vec3(1e-3), lessThan(sqr(eta) + sqr(k), vec3(1e-6)));
    vec3 real = (eta - 1.0) * (eta + 1.0) - sqr(k);
    vec3 imaginary2 = 4.0 * sqr(eta * k);
    return Conductor(real, imaginary2, sqr(real) + imaginary2);
}

// Conductor: the dielectric's formulas with a complex index, t = a + ib, t² = (eta + ik)² − sin², m = |t|²:
//   R = |1 − (eta + ik)²|² (C m + sin⁴) / ((C + m + 2ac)² (C m + sin⁴ + 2ac sin²)),
// sums of positive terms only. a² = (m + Re t²)/2 would cancel where k ≫ eta and Re t² < 0; there it is (eta k)²/b².
vec3 fresnel_conductor(Conductor metal, float cos2) {
    float sin2 = 1.0 - cos2;
    vec3 real = metal.real + cos2;
    vec3 m = sqrt(sqr(real) + metal.imaginary2);
    vec3 larger = 0.5 * (m + abs(real));
    vec3 smaller = 0.25 * metal.imaginary2 / max(larger, TINY);
    vec3 ac = sqrt(mix(smaller, larger, greaterThanEqual(real, vec3(0.0))) * cos2);
    vec3 p_mean = m * cos2 + sqr(sin2);
    vec3 denominator = sqr(m + cos2 + 2.0 * ac) * (p_mean + (2.0 * sin2) * ac);
    return metal.difference2 * p_mean / max(denominator, TINY);
}

// Schlick 1994: the weight (1 − wi·h)⁵ of white, with 1 − wi·h = |wi − wo|² / (4 (1 + wi·h)): near normal incidence
// 1 − (wi·h) has no correct digit, and sheen and a black F0 have no other term to hide that.
float schlick_weight(vec3 wo, vec3 wi, float cosine) {
    vec3 d = wi - wo;
    return pow5(0.25 * dot(d, d) / (1.0 + cosine));
}

#endif
