// Set 1: the tables of linearly transformed cosines that the scene's lobes use, two layers each: shapes, then moments.
// Read texel by texel: filters of 8 bits of fraction, which Vulkan allows, would undo the tables' 16.
#ifndef BIND_LTC_GLSL
#define BIND_LTC_GLSL

#include "lib/area/proxy.glsl"

layout(set = SET_scene, binding = SCENE_LTC) uniform texture2DArray ltc_tables;

// Layer of the table of the specular lobe and of the coat; which table that is, the BSDF decides.
layout(constant_id = 12) const uint LTC_SPECULAR = 0u;
layout(constant_id = 13) const uint LTC_COAT = 0u;
// Principled: the table is that of F = 1, not of a dielectric.
layout(constant_id = 15) const bool LTC_METALLIC = false;

vec4 ltc_bilinear(int layer, vec2 at, ivec2 last) {
    ivec2 low = min(ivec2(at), last);
    ivec2 high = min(low + 1, last);
    vec2 t = at - vec2(low);
    vec4 upper = mix(texelFetch(ltc_tables, ivec3(low, layer), 0),
                     texelFetch(ltc_tables, ivec3(high.x, low.y, layer), 0), t.x);
    vec4 lower = mix(texelFetch(ltc_tables, ivec3(low.x, high.y, layer), 0),
                     texelFetch(ltc_tables, ivec3(high, layer), 0), t.x);
    return mix(upper, lower, t.y);
}

// The matrix's four numbers and the moments at r = √alpha and n·wo; see `amas::ltc`.
struct LtcTexel {
    vec4 shape;
    vec4 moments;
};

LtcTexel ltc_at(uint table, float r, float cos_o) {
    int layer = 2 * int(table);
    // Behind the last row: last column, last row, r of the first and of the last column.
    vec4 axes = texelFetch(ltc_tables, ivec3(0, LTC_ROWS, layer), 0);
    vec2 unit = vec2((r - axes.z) / (axes.w - axes.z), view_coordinate(cos_o));
    vec2 at = clamp(unit, 0.0, 1.0) * axes.xy;
    return LtcTexel(ltc_bilinear(layer, at, ivec2(axes.xy)), ltc_bilinear(layer + 1, at, ivec2(axes.xy)));
}

#endif
