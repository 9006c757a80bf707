// The material of a probe's row.
#ifndef PROBE_BSDF_ROW_GLSL
#define PROBE_BSDF_ROW_GLSL

#include "lib/bsdf/parameters.glsl"

BsdfParameters row_parameters(BsdfProbeRow row) {
    BsdfParameters p;
    p.color = row.color_alpha_x.rgb;
    p.alpha_x = row.color_alpha_x.w;
    p.specular = row.specular_alpha_y.rgb;
    p.alpha_y = row.specular_alpha_y.w;
    p.sigma = row.surface.x;
    p.eta = row.surface.y;
    p.metallic = row.surface.z;
    p.roughness = row.surface.w;
    p.specular_tint = row.tints.x;
    p.sheen = row.tints.y;
    p.sheen_tint = row.tints.z;
    p.clearcoat = row.tints.w;
    p.clearcoat_gloss = row.rest.x;
    p.subsurface = row.rest.y;
    return p;
}

#endif
