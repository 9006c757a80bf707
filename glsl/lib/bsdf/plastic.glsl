// Lambert and an uncoupled dielectric microfacet layer, diffuse/π + specular · D V F (Walter 2007, Heitz 2014):
// pbrt-v3's plastic with Fresnel from air to eta, which its own material has the wrong way round.
#ifndef LIB_BSDF_PLASTIC_GLSL
#define LIB_BSDF_PLASTIC_GLSL

#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/microfacet.glsl"
#include "lib/bsdf/parameters.glsl"

struct Plastic {
    vec3 diffuse;  // diffuse/π
    vec3 specular; // specular with the constants of D and V
    vec3 wo;
    Ggx ggx;
    float eta2_minus_1;
};

Plastic plastic_setup(BsdfParameters p, vec3 wo) {
    Plastic m;
    m.ggx = ggx_setup(p.alpha_x, p.alpha_y, wo);
    m.diffuse = p.color * (INV_PI * faces_viewer(wo));
    m.specular = p.specular * (0.5 * m.ggx.norm * faces_viewer(wo));
    m.wo = wo;
    m.eta2_minus_1 = (p.eta - 1.0) * (p.eta + 1.0);
    return m;
}

vec3 plastic_diffuse_cos(Plastic m, vec3 wi) { return m.diffuse * max(wi.z, 0.0); }

vec3 plastic_specular_cos(Plastic m, vec3 wi) {
    HalfVector h = half_vector(m.wo, wi);
    float lobe = ggx_distribution(m.ggx, h) * ggx_visibility_correlated(m.ggx, m.wo.z, max(wi.z, 0.0), wi);
    return m.specular * (lobe * fresnel_dielectric(m.eta2_minus_1, 0.25 * h.length2));
}

vec3 plastic_eval_cos(Plastic m, vec3 wi) { return plastic_diffuse_cos(m, wi) + plastic_specular_cos(m, wi); }

#endif
