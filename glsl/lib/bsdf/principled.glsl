// Burley 2012, "Physically-Based Shading at Disney", with the exact eta in F0 and a separable Smith G.
#ifndef LIB_BSDF_PRINCIPLED_GLSL
#define LIB_BSDF_PRINCIPLED_GLSL

#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/microfacet.glsl"
#include "lib/bsdf/parameters.glsl"

const float CLEARCOAT_F0 = 0.04;
// Burley fixes the alpha of the clearcoat's G, whatever that of its D.
const float CLEARCOAT_G_ALPHA2 = 0.0625;

struct Principled {
    vec3 wo;
    float cos_o;
    float fresnel_o;   // FV = (1 − cosθo)⁵
    float roughness;
    vec3 diffuse;      // (1 − metallic)(1 − subsurface) color/π
    vec3 subsurface;   // (1 − metallic) subsurface 1.25 color/π
    vec3 sheen;        // (1 − metallic) sheen lerp(1, C_tint, sheen_tint)
    vec3 f0;           // with the constants of D and V, as is
    float f90;         // the same for white
    Ggx ggx;
    float coat;        // clearcoat with the constants of D and V
    float coat_alpha2;
};

// 1 / V1(w).
float clearcoat_shadowing(float c) {
    return c + sqrt(CLEARCOAT_G_ALPHA2 + (1.0 - CLEARCOAT_G_ALPHA2) * sqr(c));
}

// The colour at luminance 1.
vec3 principled_tint(vec3 color) {
    float y = luminance(color);
    return y > 0.0 ? color / y : vec3(1.0);
}

// Reflectance along the normal.
vec3 principled_f0(BsdfParameters p) {
    vec3 tint = lerp(vec3(1.0), principled_tint(p.color), p.specular_tint);
    vec3 dielectric = sqr((p.eta - 1.0) / (p.eta + 1.0)) * tint;
    return lerp(dielectric, p.color, LOBE_METALLIC ? p.metallic : 0.0);
}

Principled principled_setup(BsdfParameters p, vec3 wo) {
    float facing = faces_viewer(wo);
    float cos_o = max(wo.z, 0.0);
    float metallic = LOBE_METALLIC ? p.metallic : 0.0;
    float subsurface = LOBE_SUBSURFACE ? p.subsurface : 0.0;
    vec3 albedo = (facing * (1.0 - metallic) * INV_PI) * p.color;

    Principled m;
    m.wo = wo;
    m.cos_o = cos_o;
    m.fresnel_o = pow5(max(1.0 - cos_o, 0.0));
    m.roughness = p.roughness;
    m.diffuse = (1.0 - subsurface) * albedo;
    m.subsurface = (1.25 * subsurface) * albedo;
    m.sheen = (facing * (1.0 - metallic) * p.sheen) * lerp(vec3(1.0), principled_tint(p.color), p.sheen_tint);

    m.ggx = ggx_setup(p.alpha_x, p.alpha_y, wo);
    m.f90 = facing * m.ggx.norm / (cos_o + m.ggx.stretch_o);
    m.f0 = m.f90 * principled_f0(p);

    float a2 = sqr(lerp(0.1, 0.001, p.clearcoat_gloss));
    m.coat_alpha2 = a2;
    // log() is good to 3 ulp here: Vulkan loosens it only between ½ and 2, and a2 ≤ 0.01.
    float gtr1_norm = INV_PI * (a2 - 1.0) / log(a2);
    m.coat = facing * 0.25 * p.clearcoat * gtr1_norm / clearcoat_shadowing(cos_o);
    return m;
}

// Fss (1/(cosθi + cosθo) − ½) + ½: Hanrahan and Krueger's single scattering flattened to a diffuse shape.
float principled_subsurface(Principled m, float cos_i, float fresnel_i, float fss90) {
    float fss = (schlick_complement(cos_i) + fss90 * fresnel_i) * (schlick_complement(m.cos_o) + fss90 * m.fresnel_o);
    return fss / max(cos_i + m.cos_o, TINY) + 0.5 * (1.0 - fss);
}

// GTR1 (γ = 1), whose normalisation (alpha² − 1)/(π ln alpha²) is in `coat`, with V1(wi) and F.
float principled_clearcoat(Principled m, HalfVector h, float cos_i, float schlick) {
    float d = h.squared.x + h.squared.y + m.coat_alpha2 * h.squared.z;
    float denominator = max(d * clearcoat_shadowing(cos_i), TINY);
    return m.coat * h.length2 / denominator * (CLEARCOAT_F0 + (1.0 - CLEARCOAT_F0) * schlick);
}

// What all lobes share of a pair of directions.
struct PrincipledPair {
    HalfVector h;
    float schlick;
    float cos_i;
};

PrincipledPair principled_pair(Principled m, vec3 wi) {
    HalfVector h = half_vector(m.wo, wi);
    return PrincipledPair(h, schlick_weight(m.wo, wi, 0.5 * sqrt(h.length2)), max(wi.z, 0.0));
}

// Diffuse and retro-reflection share color/π: (1 − FL/2)(1 − FV/2) + RR (FL + FV + FL FV (RR − 1)).
vec3 principled_diffuse_cos(Principled m, PrincipledPair p) {
    float fresnel_i = pow5(max(1.0 - p.cos_i, 0.0));
    float rr = 0.5 * m.roughness * p.h.length2;
    float diffuse = (1.0 - 0.5 * fresnel_i) * (1.0 - 0.5 * m.fresnel_o) +
                    rr * (fresnel_i + m.fresnel_o * (1.0 + fresnel_i * (rr - 1.0)));
    vec3 f_cos = m.diffuse * (p.cos_i * diffuse);
    if (LOBE_SUBSURFACE) {
        f_cos += m.subsurface * (p.cos_i * principled_subsurface(m, p.cos_i, fresnel_i, 0.5 * rr));
    }
    if (LOBE_SHEEN) {
        f_cos += m.sheen * (p.cos_i * p.schlick);
    }
    return f_cos;
}

vec3 principled_specular_cos(Principled m, PrincipledPair p, vec3 wi) {
    float lobe = ggx_distribution(m.ggx, p.h) * ggx_visibility_separable(m.ggx, p.cos_i, wi);
    return m.f0 * (lobe - lobe * p.schlick) + m.f90 * (lobe * p.schlick);
}

float principled_coat_cos(Principled m, PrincipledPair p) {
    return LOBE_CLEARCOAT ? p.cos_i * principled_clearcoat(m, p.h, p.cos_i, p.schlick) : 0.0;
}

vec3 principled_eval_cos(Principled m, vec3 wi) {
    PrincipledPair p = principled_pair(m, wi);
    return principled_diffuse_cos(m, p) + principled_specular_cos(m, p, wi) + principled_coat_cos(m, p);
}

#endif
