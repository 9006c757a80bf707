// Conductor microfacets, single scattering: D V F (Walter et al. 2007, Heitz 2014).
#ifndef LIB_BSDF_METAL_GLSL
#define LIB_BSDF_METAL_GLSL

#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/microfacet.glsl"
#include "lib/bsdf/parameters.glsl"

struct Metal {
    Conductor conductor;
    Ggx ggx;
    float scale; // the constants of D and V
    vec3 wo;
};

Metal metal_setup(BsdfParameters p, vec3 wo) {
    Ggx ggx = ggx_setup(p.alpha_x, p.alpha_y, wo);
    return Metal(conductor_setup(p.color, p.specular), ggx, 0.5 * ggx.norm * faces_viewer(wo), wo);
}

vec3 metal_eval_cos(Metal m, vec3 wi) {
    float cos_i = max(wi.z, 0.0);
    HalfVector h = half_vector(m.wo, wi);
    float lobe = ggx_distribution(m.ggx, h) * ggx_visibility_correlated(m.ggx, m.wo.z, cos_i, wi);
    return (m.scale * lobe) * fresnel_conductor(m.conductor, 0.25 * h.length2);
}

#endif
