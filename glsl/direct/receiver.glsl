// A surface ready for area lights: its lobes in coordinates of their own.
#ifndef DIRECT_RECEIVER_GLSL
#define DIRECT_RECEIVER_GLSL

#include "bind/bvh.glsl"
#include "bind/ltc.glsl"
#include "bind/plane.glsl"
#include "bind/surface.glsl"
#include "direct/albedo.glsl"
#include "lib/area/proxy.glsl"

layout(constant_id = 14) const bool CLOSED_FORM = false;
layout(constant_id = 38) const bool SHADOWS = false;

// A lobe's coordinates, and how wide it is where it is narrowest, as the tangent of an angle.
struct Lobe {
    Proxy proxy;
    float width;
};

struct Receiver {
    Surface surface;
    Lobe diffuse;
    Lobe specular;
    Lobe coat;
    float narrowest;
    bool grazing;
    vec3 mass;        // albedo of the specular lobe
    float variation;  // and how far its transformed cosine is from it, at most: total variation
    vec3 shadow_origin;
};

// Below this cosine the tables' matrices are nearly singular; the quadrature needs no exact fit.
const float LEAST_COSINE = 0.01;

// A lobe's width across the plane of incidence is alpha, along it alpha cosθo: between the two.
float lobe_width(float alpha, float cos_o) { return alpha * sqrt(cos_o); }

Lobe specular_lobe(LtcTexel texel, vec2 alpha, vec3 wo, float cos_o) {
    float mean = ANISOTROPIC ? sqrt(alpha.x * alpha.y) : alpha.x;
    Proxy proxy = proxy_of_microfacets(texel.shape, 2.0 * mean, wo);
    if (ANISOTROPIC) proxy = proxy_anisotropic(proxy, alpha, wo);
    return Lobe(proxy, lobe_width(ANISOTROPIC ? min(alpha.x, alpha.y) : alpha.x, cos_o));
}

// GTR1's tails make its best cosine √alpha wide, its peak alpha.
Lobe coat_lobe(float alpha, vec3 wo, float cos_o) {
    vec4 shape = ltc_at(LTC_COAT, sqrt(alpha), cos_o).shape;
    return Lobe(proxy_of_microfacets(shape, sqrt(alpha), wo), lobe_width(alpha, cos_o));
}

Proxy receiver_proxy(Receiver r, uint lobe) {
    return lobe == LOBE_DIFFUSE ? r.diffuse.proxy : lobe == LOBE_SPECULAR ? r.specular.proxy : r.coat.proxy;
}

// Off the triangle, on the viewer's side.
vec3 seen_origin(vec3 p) { return offset_origin(p, plane_normal(p, view_direction()), distance(p, frame.eye)); }

Receiver receiver_here() {
    Receiver r;
    r.surface = surface_here();
    vec3 wo = view_direction() * r.surface.world_from_local;
    float cos_o = max(wo.z, LEAST_COSINE);
    BsdfParameters p = surface_parameters();
    r.diffuse = Lobe(proxy_of_cosine(), 1.0);
    r.narrowest = 1.0;
    r.grazing = wo.z < 0.35;
    if (bsdf_has(LOBE_SPECULAR)) {
        float alpha = ANISOTROPIC ? sqrt(p.alpha_x * p.alpha_y) : p.alpha_x;
        LtcTexel texel = ltc_at(LTC_SPECULAR, sqrt(alpha), cos_o);
        r.specular = specular_lobe(texel, vec2(p.alpha_x, p.alpha_y), wo, cos_o);
        if (CLOSED_FORM) {
            Albedo albedo = specular_albedo(p, texel.moments);
            r.mass = albedo.mass;
            r.variation = texel.moments.w + albedo.unfitted;
        }
        r.narrowest = min(r.narrowest, r.specular.width);
    }
    if (bsdf_has(LOBE_COAT)) {
        r.coat = coat_lobe(lerp(0.1, 0.001, p.clearcoat_gloss), wo, cos_o);
        r.narrowest = min(r.narrowest, r.coat.width);
    }
    if (SHADOWS) r.shadow_origin = seen_origin(r.surface.position);
    return r;
}

#endif
