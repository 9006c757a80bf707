// Directions of the lobes that BSDFs are sampled by, and their densities per solid angle, as functions of two numbers in
// [0, 1). Cosines are taken within [−π, π], where Vulkan bounds their error.
#ifndef LIB_BSDF_LOBE_SAMPLING_GLSL
#define LIB_BSDF_LOBE_SAMPLING_GLSL

#include "lib/bsdf/microfacet.glsl"

vec2 circle(float turn) {
    float phi = PI * (2.0 * turn - 1.0);
    return vec2(cos(phi), sin(phi));
}

// Density cosθ/π, by Shirley and Chiu's concentric map, which keeps neighbours together.
vec3 cosine_direction(vec2 xi) {
    vec2 p = 2.0 * xi - 1.0;
    bool wide = abs(p.x) > abs(p.y);
    float r = wide ? p.x : p.y;
    float phi = 0.25 * PI * (wide ? p.y : p.x) / (r == 0.0 ? 1.0 : r);
    vec2 near_axis = r * vec2(cos(phi), sin(phi));
    return vec3(wide ? near_axis : near_axis.yx, sqrt((1.0 - r) * (1.0 + r)));
}

// Density 1/(2π).
vec3 even_direction(vec2 xi) {
    float c = 1.0 - xi.x;
    return vec3(sqrt(xi.x * (1.0 + c)) * circle(xi.y), c);
}

// A normal visible from wo, by Dupuy and Benyoub 2023: what the stretched hemisphere reflects is a cap of the sphere, on
// which directions are even. 1 − z = x (1 + v.z) and what is below are sums of positive terms, so that no digit is lost
// along the normal nor at grazing angles.
vec3 ggx_visible_normal(Ggx ggx, vec3 wo, vec2 xi) {
    vec2 alpha = sqrt(ggx.alpha2);
    vec3 v = normalize(vec3(alpha * wo.xy, wo.z));
    float above = (1.0 - xi.x) * (1.0 + v.z); // z + v.z
    float sine = sqrt(max(xi.x * (1.0 + v.z) * (1.0 - v.z + above), 0.0));
    return normalize(vec3(alpha * (sine * circle(xi.y) + v.xy), above));
}

// Of the reflection about such a normal: G1(wo) D(h)/(4 cosθo).
float ggx_pdf(Ggx ggx, HalfVector h, float cos_o) {
    return 0.5 * ggx.norm * ggx_distribution(ggx, h) / (cos_o + ggx.stretch_o);
}

struct Gtr1 {
    float alpha2;
    float norm;
};

Gtr1 gtr1_setup(float alpha) {
    float a2 = sqr(alpha);
    return Gtr1(a2, INV_PI * (a2 - 1.0) / log(a2));
}

// A normal of density D(h) n·h (Burley 2012, appendix B): sin²θ = α² (α^−2ξ − 1)/(1 − α²).
vec3 gtr1_normal(Gtr1 lobe, vec2 xi) {
    float sin2 = clamp(lobe.alpha2 * (exp2(-xi.x * log2(lobe.alpha2)) - 1.0) / (1.0 - lobe.alpha2), 0.0, 1.0);
    return vec3(sqrt(sin2) * circle(xi.y), sqrt(1.0 - sin2));
}

// Of the reflection about such a normal: D(h) n·h/(4 wi·h).
float gtr1_pdf(Gtr1 lobe, HalfVector h) {
    float d = h.squared.x + h.squared.y + lobe.alpha2 * h.squared.z;
    return 0.5 * lobe.norm * sqrt(h.squared.z) / max(d, TINY);
}

#endif
