// Step 10, where lists are longer than the cap: one workgroup a cluster. Its strongest lights are listed, in Hilbert order;
// the rest is folded into a node for each octant of directions, behind the list.
//
// lavapipe ends an invocation's loops after 65,535 iterations in all: of a million lights, 1,024 rounds of 17 and of 35.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"
#include "lib/light.glsl"
#include "lib/parent.glsl"
#include "cluster/reach.glsl"
#include "cluster/members.glsl"

#define LANES FOLD_LANES
#include "cluster/lane_sums.glsl"

layout(local_size_x = FOLD_LANES) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;

// Of a strength's bits: exponent and three of the mantissa.
const uint BIN_SHIFT = 20u;
const uint BINS = 2048u;
// Lights of a group that are unrolled.
const uint UNROLLED = 2u;

Cluster here;
Cluster parent;

#include "cluster/fold_points.glsl"
#include "cluster/fold.glsl"

// The i-th light of a group.
uint light_of(uint group, uint i) {
    return parent_kind(parent) == OF_LIGHTS ? entry_of(parent, group * LEAF_LIGHTS + i)
                                            : leaf_of(parent, group) * LEAF_LIGHTS + i;
}

// Lights of a group that reach the cluster.
uint hits_of(uint id, uint group) {
    if (group >= parent_groups(parent)) return 0u;
    if (parent_kind(parent) != OF_LIGHTS) return crowd_hits(parent, group, here.lower, here.upper);
    return pick(imageLoad(light_lists, list_texel(sibling_masks(id) + group)), id % SIBLINGS);
}

uint bin_of(float strength) { return min(floatBitsToUint(strength) >> BIN_SHIFT, BINS - 1u); }

void note(uint group, uint hits) {
    while (hits != 0u) {
        [[unroll]] for (uint i = 0u; i < UNROLLED; ++i) {
            float value = strength(light_of(group, uint(findLSB(hits)) & 31u));
            if (hits != 0u) atomicAdd(words[bin_of(value)], 1u);
            hits &= hits - 1u;
        }
    }
}

// Lights among `hits` whose bin is above the threshold, and in it.
uvec2 stronger(uint group, uint hits, uint threshold) {
    uvec2 found = uvec2(0u);
    while (hits != 0u) {
        [[unroll]] for (uint i = 0u; i < UNROLLED; ++i) {
            uint at = uint(findLSB(hits)) & 31u;
            float value = strength(light_of(group, at));
            uint bin = bin_of(value);
            if (hits != 0u) {
                total += value;
                found |= uvec2(uint(bin > threshold), uint(bin == threshold)) << at;
            }
            hits &= hits - 1u;
        }
    }
    return found;
}

// The bin of the weakest lights kept, and how many of it are.
uvec2 threshold_of(uint cap) {
    uint above = 0u;
    uint bin = BINS - 1u;
    for (; bin > 0u && above + words[bin] < cap; --bin) above += words[bin];
    return uvec2(bin, cap - above);
}

// Those bits of `word` with fewer than `count` set ones below.
uint lowest(uint word, uint count) {
    uint rest = word;
    for (uint i = 0u; i < count && rest != 0u; ++i) rest &= rest - 1u;
    return word & ~rest;
}

// What is left of `room` behind the invocations below, whose sum is the first of `sums`.
uint room_of(uint room, uvec4 sums) { return room - min(room, sums.x); }

#include "cluster/append.glsl"

void main() {
    uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (workgroup >= counters.overflowed) return;
    uint lane = gl_LocalInvocationIndex;
    uint id = clusters[workgroup].folded;
    here = clusters[id];
    parent = clusters[frame.cluster_capacity + here.parent];
    begin_list(here.list, (frame.max_list + 3u) / 4u);
    if (end + FOLD_ROOM > frame.list_capacity) return;
    load_points(here);
    uint groups = parent_groups(parent);

    for (uint i = lane; i < BINS; i += FOLD_LANES) words[i] = 0u;
    barrier();
    for (uint first = 0u; first < groups; first += FOLD_LANES) note(first + lane, hits_of(id, first + lane));
    barrier();
    uvec2 threshold = threshold_of(frame.max_list);
    barrier();
    clear_nodes();
    uint room = frame.max_list;
    for (uint first = 0u; first < groups; first += FOLD_LANES) {
        uint hits = hits_of(id, first + lane);
        uvec2 found = stronger(first + lane, hits, threshold.x);
        uvec4 ties = lane_sums(uvec2(bitCount(found.y), 0u));
        uint listed = found.x | lowest(found.y, room_of(threshold.y, ties));
        threshold.y -= min(threshold.y, ties.z);
        // The threshold leaves as much as there is room for; should the two disagree, what is too much is folded.
        uvec4 sums = lane_sums(uvec2(bitCount(listed), 0u));
        listed = lowest(listed, room_of(room, sums));
        append(first + lane, listed, sums, room);
        room -= min(room, sums.z);
        fold(first + lane, hits & ~listed);
    }
    end_list();
    write_nodes(id, end);
}
