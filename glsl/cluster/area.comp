// Step 5: which area lights reach each cluster: masks, in the texels before the lists. A light is left out only if no point
// of the cluster's box can be lit by it: black, or one-sided and the box behind it.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/area_lights.glsl"
#include "lib/cluster.glsl"

layout(local_size_x = LINEAR_GROUP) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

// What float32 may lose of a sum of products, relative to their size.
const float ROUNDING = 1e-6;

bool reaches(AreaLight light, vec3 middle, vec3 half_size) {
    vec3 offset = middle - light.center;
    float before = dot(light.normal, offset) + dot(abs(light.normal), half_size);
    float slack = ROUNDING * (dot(abs(light.center), vec3(1.0)) + dot(abs(middle) + half_size, vec3(1.0)));
    bool behind = light.kind != AREA_LINE && !light.two_sided && before < -slack;
    bool black = all(lessThanEqual(light.radiance, vec3(0.0)));
    return !behind && !black;
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint id = group * LINEAR_GROUP + gl_LocalInvocationIndex;
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    vec3 middle = 0.5 * (clusters[id].lower + clusters[id].upper);
    vec3 half_size = 0.5 * (clusters[id].upper - clusters[id].lower);
    for (uint texel = 0u; texel < frame.area_texels; ++texel) {
        uint first = texel * AREA_MASK_LIGHTS;
        uvec4 masks = uvec4(0u);
        uint count = min(frame.area_lights - first, AREA_MASK_LIGHTS);
        for (uint i = 0u; i < count; ++i) {
            if (reaches(area_light(first + i), middle, half_size)) masks[i >> 5] |= 1u << (i & 31u);
        }
        imageStore(light_lists, list_texel(id * frame.area_texels + texel), masks);
    }
}
