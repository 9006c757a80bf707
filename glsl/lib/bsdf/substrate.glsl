// Ashikhmin and Shirley 2000, with the Trowbridge–Reitz D: a diffuse base that keeps what the glossy coat lets through.
#ifndef LIB_BSDF_SUBSTRATE_GLSL
#define LIB_BSDF_SUBSTRATE_GLSL

#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/microfacet.glsl"
#include "lib/bsdf/parameters.glsl"

struct Substrate {
    vec3 base;       // 28 Rd/(23π) (1 − Rs)(1 − (1 − cosθo/2)⁵)
    vec3 coat;       // Rs/4 with the constant of D
    vec3 white;      // (1 − Rs)/4 with the constant of D
    vec3 wo;
    float inv_cos_o;
    Ggx ggx;
};

Substrate substrate_setup(BsdfParameters p, vec3 wo) {
    Substrate m;
    m.ggx = ggx_setup(p.alpha_x, p.alpha_y, wo);
    float facing = faces_viewer(wo);
    float diffuse = facing * (28.0 / 23.0) * INV_PI * schlick_complement(0.5 * wo.z);
    m.base = diffuse * p.color * (1.0 - p.specular);
    m.coat = (facing * 0.25 * m.ggx.norm) * p.specular;
    m.white = (facing * 0.25 * m.ggx.norm) * (1.0 - p.specular);
    m.wo = wo;
    m.inv_cos_o = 1.0 / max(wo.z, MIN_COSINE);
    return m;
}

vec3 substrate_diffuse_cos(Substrate m, vec3 wi) {
    float cos_i = max(wi.z, 0.0);
    return m.base * (cos_i * schlick_complement(0.5 * cos_i));
}

// The coat is D F/(4 (wi·h) max(cosθi, cosθo)); cosθi/max(cosθi, cosθo) needs no division here.
vec3 substrate_specular_cos(Substrate m, vec3 wi) {
    HalfVector h = half_vector(m.wo, wi);
    float cosine = 0.5 * sqrt(h.length2);
    float cosines = min(max(wi.z, 0.0) * m.inv_cos_o, 1.0);
    float lobe = ggx_distribution(m.ggx, h) * cosines / max(cosine, MIN_COSINE);
    return (m.coat + m.white * schlick_weight(m.wo, wi, cosine)) * lobe;
}

vec3 substrate_eval_cos(Substrate m, vec3 wi) { return substrate_diffuse_cos(m, wi) + substrate_specular_cos(m, wi); }

#endif
