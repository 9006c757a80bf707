// Fresnel reflectances for unpolarised light as functions of C = (wi·h)² = |wi + wo|²/4.
#ifndef LIB_BSDF_FRESNEL_GLSL
#define LIB_BSDF_FRESNEL_GLSL

#include "lib/math.glsl"

// Dielectric, air to eta, given eta² − 1. With t² = eta² − sin² = eta² − 1 + C, the amplitudes are
//   r_s = (c − t)/(c + t) = (1 − eta²)/(c + t)²,   r_p = r_s (ct − sin²)/(ct + sin²),
// so nothing cancels as eta → 1, and (r_s² + r_p²)/2 needs one root, p = ct, and one division. Beyond total reflection
// t is clamped to 0 and the quotient exceeds 1.
float fresnel_dielectric(float eta2_minus_1, float cos2) {
    float t2 = max(eta2_minus_1 + cos2, 0.0);
    float sin2 = 1.0 - cos2;
    float p2 = cos2 * t2;
    float p = sqrt(p2);
    float denominator = sqr((cos2 + t2 + 2.0 * p) * (p + sin2));
    return min(sqr(eta2_minus_1) * (p2 + sqr(sin2)) / max(denominator, TINY), 1.0);
}

struct Conductor {
    vec3 eta2_k2_1; // eta² − k² − 1
    vec3 eta_k;     // eta·k
};

// An index of 0 has R = 1 at every angle and so has any imaginary index; the substitute keeps 0/0 out of the loop.
Conductor conductor_setup(vec3 eta, vec3 k) {
    k = mix(k, vec3(1e-4), lessThan(sqr(eta) + sqr(k), vec3(1e-8)));
    return Conductor((eta - 1.0) * (eta + 1.0) - sqr(k), eta * k);
}

// Conductor: a + ib = √(eta² − k² − sin² + 2i eta·k),
//   R_s = ((a − c)² + b²)/((a + c)² + b²),   R_p = R_s ((ca − sin²)² + (cb)²)/((ca + sin²)² + (cb)²).
// The larger of a and b, `root`, comes from a sum without cancellation and the smaller is eta·k/root; all terms are
// multiplied by root, which leaves two roots and one division per channel.
vec3 fresnel_conductor(Conductor metal, float cos2) {
    float c = sqrt(cos2);
    float sin2 = 1.0 - cos2;
    vec3 real = metal.eta2_k2_1 + cos2;
    vec3 root2 = 0.5 * (sqrt(sqr(real) + 4.0 * sqr(metal.eta_k)) + abs(real));
    vec3 root = sqrt(root2);
    bvec3 refracts = greaterThanEqual(real, vec3(0.0));
    vec3 a = mix(metal.eta_k, root2, refracts);
    vec3 b = mix(root2, metal.eta_k, refracts);
    vec3 s_minus = sqr(a - c * root) + sqr(b);
    vec3 p_minus = sqr(c * a - sin2 * root) + sqr(c * b);
    vec3 half_gap = (2.0 * c) * a * root;
    vec3 s_plus = s_minus + 2.0 * half_gap;
    vec3 p_mean = p_minus + sin2 * half_gap;
    vec3 p_plus = p_mean + sin2 * half_gap;
    return s_minus * p_mean / max(s_plus * p_plus, TINY);
}

// Schlick 1994: the weight (1 − wi·h)⁵ of white, with 1 − wi·h = |wi − wo|²/(4 (1 + wi·h)): near normal incidence
// 1 − wi·h itself has no correct digit, and sheen and a black F0 have no other term to hide that.
float schlick_weight(vec3 wo, vec3 wi, float length2) {
    vec3 d = wi - wo;
    float c = 0.5 * sqrt(length2);
    return pow5(0.25 * dot(d, d) / (1.0 + c));
}

#endif
