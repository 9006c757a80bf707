// Step 9: the lists, four indices a texel, padded with the null light so that the shading loop has no tail.
//
// lavapipe ends an invocation's loops after 65,535 iterations in all: a million lights are 16,384 pairs of leaves, with an
// iteration each for what does not reach, and as many more as the list is long, eight lists at a time.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"
#include "lib/parent.glsl"
#include "cluster/reach.glsl"
#include "cluster/members.glsl"

layout(local_size_x = LINEAR_GROUP) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };

uint masks;  // texel of the masks
uint child;  // component of these
Cluster parent;
uint group = 0u;  // behind that of `hits`
uint groups;
uint hits = 0u;

// The next light that reaches the cluster; the null light once there is none.
uint next_light() {
    while (hits == 0u && group < groups) {
        hits = pick(imageLoad(light_lists, list_texel(masks + group)), child);
        ++group;
    }
    uint light = entry_of(parent, (max(group, 1u) - 1u) * LEAF_LIGHTS + (uint(findLSB(hits)) & 31u));
    light = hits == 0u ? frame.light_count : light;
    hits &= hits - 1u;
    return light;
}

// In step: every cluster's next four lights, then a store.
void write_masked(uint texel, uint texels) {
    groups = parent_groups(parent);
    for (uint i = 0u; i < texels; ++i) {
        uint x = next_light();
        uint y = next_light();
        uint z = next_light();
        uint w = next_light();
        imageStore(light_lists, list_texel(texel + i), uvec4(x, y, z, w));
    }
}

// Crowded parents have no masks: their lights are tested again, for all their clusters in step. That is cheaper than masks
// would be large. (light_grid with 65,536 lights, 31 such parents of 464: cluster 374 CPU ms
// when the fold step wrote these lists, 144 so, lists read as images included.)
void write_tested(uint texel, uint texels, vec3 lower, vec3 upper) {
    // Whatever the tests say: not into the next list.
    uint end = texel + texels;
    uint all = parent_groups(parent);
    uvec4 four = uvec4(frame.light_count);
    uint count = 0u;
    for (uint first = 0u; first < all; first += 2u) {
        uint left = crowd_hits(parent, first, lower, upper);
        uint right = first + 1u < all ? crowd_hits(parent, first + 1u, lower, upper) : 0u;
        uint left_light = leaf_of(parent, first) * LEAF_LIGHTS;
        uint right_light = leaf_of(parent, first + 1u) * LEAF_LIGHTS;
        while ((left | right) != 0u) {
            uint light = left != 0u ? left_light + uint(findLSB(left)) : right_light + uint(findLSB(right));
            right = left != 0u ? right : right & (right - 1u);
            left &= left - 1u;
            four = uvec4(four.yzw, light);
            if ((++count & 3u) == 0u && texel < end) imageStore(light_lists, list_texel(texel++), four);
        }
    }
    uint none = frame.light_count;
    four = (count & 3u) == 1u ? uvec4(four.w, none, none, none)
                              : (count & 3u) == 2u ? uvec4(four.zw, none, none) : uvec4(four.yzw, none);
    if ((count & 3u) != 0u && texel < end) imageStore(light_lists, list_texel(texel++), four);
    for (; texel < end; ++texel) imageStore(light_lists, list_texel(texel), uvec4(none));
}

void main() {
    uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint id = workgroup * LINEAR_GROUP + gl_LocalInvocationIndex;
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    Cluster here = clusters[id];
    if (here.parent >= frame.parent_capacity) return;
    parent = clusters[frame.cluster_capacity + here.parent];
    uint texels = (here.reaching + 3u) / 4u;
    if (here.list + texels > frame.list_capacity) return;
    // Step 10 makes these.
    if (here.reaching > frame.max_list) return;
    masks = sibling_masks(id);
    child = id % SIBLINGS;
    if (parent_kind(parent) == OF_LIGHTS) {
        write_masked(here.list, texels);
    } else {
        write_tested(here.list, texels, here.lower, here.upper);
    }
}
