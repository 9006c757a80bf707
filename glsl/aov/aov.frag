// One arbitrary output variable, chosen by specialisation.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/within.glsl"
#include "bind/fragment.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"
#include "aov/material.glsl"
#include "aov/edge.glsl"

layout(constant_id = 11) const uint AOV = AOV_POSITION;
layout(location = 0) out vec4 value;

// Lights of the pixel's list: over those within range, all, within range.
vec3 pair_ratio(ivec2 pixel) {
    LightList list = list_at(pixel);
    uint within = lights_within(list, surface_position());
    return vec3(within == 0u ? 1.0 : float(list.count) / float(within), float(list.count), float(within));
}

// Lights of the pixel's cluster beyond its list, and those of the list.
vec3 folded(ivec2 pixel) {
    uint id = cluster_at(pixel);
    if (id >= frame.cluster_capacity) return vec3(0.0);
    uint kept = min(clusters[id].reaching, frame.max_list);
    return vec3(float(clusters[id].reaching - kept), float(kept), 0.0);
}

// Of the pixel's cluster: both estimates, from folds, from its cut.
vec3 light_error(ivec2 pixel) {
    uint id = cluster_at(pixel);
    if (id >= frame.cluster_capacity) return vec3(0.0);
    return vec3(clusters[id].error + clusters[id].cut_error, clusters[id].error, clusters[id].cut_error);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (AOV == AOV_POSITION) {
        value = vec4(surface_position(), 1.0);
    } else if (AOV == AOV_NORMAL) {
        value = vec4(shading_frame(view_direction())[2], 1.0);
    } else if (AOV == AOV_MATERIAL) {
        value = vec4(vec3(float(draw.material)), 1.0);
    } else if (AOV == AOV_LIGHT_COUNT) {
        LightList list = list_at(pixel);
        value = vec4(vec3(float(list.count + list.nodes + unranged_count(pixel) + area_count(pixel))), 1.0);
    } else if (AOV == AOV_CLUSTER) {
        uint id = cluster_at(pixel);
        value = vec4(vec3(id == NO_CLUSTER ? -1.0 : float(id)), 1.0);
    } else if (AOV == AOV_SLICE) {
        value = vec4(vec3(float(slice_of(frame, view_depth(frame, gl_FragCoord.z)))), 1.0);
    } else if (AOV == AOV_PAIR_RATIO) {
        value = vec4(pair_ratio(pixel), 1.0);
    } else if (AOV == AOV_FOLDED) {
        value = vec4(folded(pixel), 1.0);
    } else if (AOV == AOV_LIGHT_ERROR) {
        value = vec4(light_error(pixel), 1.0);
    } else if (AOV == AOV_ALBEDO) {
        value = vec4(material_color(surface_parameters()), 1.0);
    } else if (AOV == AOV_ROUGHNESS) {
        value = vec4(material_roughness(surface_parameters()), 1.0);
    } else if (AOV == AOV_DEPTH) {
        value = vec4(vec3(view_depth(frame, gl_FragCoord.z)), 1.0);
    } else if (AOV == AOV_LTC_BOUND) {
        vec3 wo = view_direction();
        value = vec4(vec3(ltc_bound(surface_parameters(), dot(wo, shading_frame(wo)[2]))), 1.0);
    } else if (AOV == AOV_WIREFRAME) {
        value = vec4(vec3(edge_distance(in_normal)), 1.0);
    } else {
        value = vec4(1.0);
    }
}
