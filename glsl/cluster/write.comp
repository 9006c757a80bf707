// Step 9: the lists, four indices a texel, padded with the null light so that the shading loop has no tail.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "lib/parent.glsl"

layout(local_size_x = LINEAR_GROUP) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS) uniform utexture2DArray parent_lists;
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

uint masks;  // texel of the masks
uint child;  // component of these
uint lights;  // texel of the parent's list
uint group = 0u;  // behind that of `hits`
uint groups;
uint hits = 0u;

// Selects, not values[i]: a dynamic index would put the vector in memory.
uint pick(uvec4 values, uint i) {
    return i == 0u ? values.x : i == 1u ? values.y : i == 2u ? values.z : values.w;
}

// The next light that reaches the cluster; the null light once there is none.
uint next_light() {
    while (hits == 0u && group < groups) {
        hits = pick(texelFetch(parent_lists, list_texel(masks + group), 0), child);
        ++group;
    }
    uint bit = uint(findLSB(hits)) & 31u;
    uint entry = (max(group, 1u) - 1u) * LEAF_LIGHTS + bit;
    uint light = pick(texelFetch(parent_lists, list_texel(lights + entry / 4u), 0), bit & 3u);
    light = hits == 0u ? frame.light_count : light;
    hits &= hits - 1u;
    return light;
}

void main() {
    uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint id = workgroup * LINEAR_GROUP + gl_LocalInvocationIndex;
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    Cluster here = clusters[id];
    if (here.parent >= frame.parent_capacity) return;
    Cluster parent = clusters[frame.cluster_capacity + here.parent];
    uint kept = min(here.reaching, frame.max_list);
    uint texels = (kept + 3u) / 4u;
    if (here.list + texels > frame.list_capacity) return;
    // Step 10 makes these.
    if (here.reaching > kept || parent_kind(parent) != OF_LIGHTS) return;
    masks = sibling_masks(id);
    child = id % SIBLINGS;
    lights = parent.list;
    groups = parent_groups(parent);
    for (uint i = 0u; i < texels; ++i) {
        uint x = next_light();
        uint y = next_light();
        uint z = next_light();
        uint w = next_light();
        imageStore(light_lists, list_texel(here.list + i), uvec4(x, y, z, w));
    }
}
