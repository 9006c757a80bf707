// Step 10, where lists are longer than the cap or parents are crowded: one workgroup a cluster. Its strongest lights are
// listed, in Hilbert order; the rest is folded into a node for each octant around the cluster, behind the list.
//
// lavapipe ends an invocation's loops after 65,535 iterations in all: a million lights are 4,096 rounds of nine.
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

#define LANES FOLD_NODES
#include "cluster/lane_sums.glsl"

layout(local_size_x = FOLD_NODES) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS) uniform utexture2DArray parent_lists;
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

// Of a strength's bits: exponent and three of the mantissa.
const uint BIN_SHIFT = 20u;
const uint BINS = 2048u;
// Lights of a group that are unrolled.
const uint UNROLLED = 16u;

shared uint bins[BINS];

Cluster here;
Cluster parent;
vec3 middle;
vec3 offsets;  // of the points of cubature, along each axis

#include "cluster/fold.glsl"

// Strength: mean irradiance over the cluster. Four points of the box whose mean is exact for quadratic functions.
float strength(uint light, out vec4 at_points) {
    vec4 place = light_place(light);
    vec4 power = light_power(light);
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        vec3 d = place.xyz - (middle + FOLD_POINTS[k] * offsets);
        at_points[k] = falloff(dot(d, d), place.w, power.w);
    }
    at_points *= dot(power.rgb, vec3(1.0 / 3.0));
    return dot(at_points, vec4(0.25));
}

uint light_of(uint group, uint i) {
    uint kind = parent_kind(parent);
    uint entry = kind == OF_LIGHTS ? group * LEAF_LIGHTS + i : group;
    uint value = texelFetch(parent_lists, list_texel(parent.list + entry / 4u), 0)[entry & 3u];
    return kind == OF_LIGHTS ? value : (kind == OF_ALL ? group : value) * LEAF_LIGHTS + i;
}

// Lights of a group that reach the cluster; those among them whose bin is above the threshold, and in it.
uvec3 group_words(uint group, uint threshold, bool note) {
    uvec3 words = uvec3(0u);
    if (group >= parent_groups(parent)) return words;
    uint left = parent_kind(parent) == OF_LIGHTS ? parent_entries(parent) - group * LEAF_LIGHTS
                                                 : frame.direct_begin - light_of(group, 0u);
    for (uint first = 0u; first < LEAF_LIGHTS; first += UNROLLED) {
        [[unroll]] for (uint j = 0u; j < UNROLLED; ++j) {
            uint light = light_of(group, first + j);
            if (first + j >= left || !reaches(light_place(light), here.lower, here.upper)) continue;
            vec4 at_points;
            uint bin = min(floatBitsToUint(strength(light, at_points)) >> BIN_SHIFT, BINS - 1u);
            if (note) atomicAdd(bins[bin], 1u);
            words |= uvec3(1u, uint(bin > threshold), uint(bin == threshold)) << (first + j);
        }
    }
    return words;
}

// The bin of the weakest lights kept, and how many of it are.
uvec2 threshold_of(uint cap) {
    uint above = 0u;
    uint bin = BINS - 1u;
    for (; bin > 0u && above + bins[bin] < cap; --bin) above += bins[bin];
    return uvec2(bin, cap - above);
}

// Those bits of `word` with fewer than `count` set ones below.
uint lowest(uint word, uint count) {
    uint rest = word;
    for (uint i = 0u; i < count && rest != 0u; ++i) rest &= rest - 1u;
    return word & ~rest;
}

#include "cluster/append.glsl"

void main() {
    uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (workgroup >= counters.folding) return;
    uint lane = gl_LocalInvocationIndex;
    uint id = clusters[workgroup].folded;
    here = clusters[id];
    if (here.parent >= frame.parent_capacity) return;
    parent = clusters[frame.cluster_capacity + here.parent];
    uint kept = min(here.reaching, frame.max_list);
    begin_list(here.list, (kept + 3u) / 4u);
    bool all_fit = kept == here.reaching;
    if (end + (all_fit ? 0u : FOLD_NODES * FOLD_TEXELS) > frame.list_capacity) return;
    middle = 0.5 * (here.lower + here.upper);
    offsets = (here.upper - here.lower) * (0.5 * inversesqrt(3.0));
    uint groups = parent_groups(parent);

    for (uint i = lane; i < BINS; i += FOLD_NODES) bins[i] = 0u;
    barrier();
    if (!all_fit) {
        for (uint first = 0u; first < groups; first += FOLD_NODES) group_words(first + lane, 0u, true);
    }
    barrier();
    uvec2 threshold = all_fit ? uvec2(0u, ~0u) : threshold_of(frame.max_list);
    clear_nodes();
    for (uint first = 0u; first < groups; first += FOLD_NODES) {
        uvec3 words = group_words(first + lane, threshold.x, false);
        uvec4 ties = lane_sums(uvec2(bitCount(words.z), 0u));
        uint quota = threshold.y > ties.x ? threshold.y - ties.x : 0u;
        uint listed = words.y | lowest(words.z, min(quota, 32u));
        threshold.y = threshold.y > ties.z ? threshold.y - ties.z : 0u;
        append(first + lane, listed);
        if (!all_fit) fold(first + lane, words.x, listed);
    }
    end_list();
    if (!all_fit) write_nodes(id, end);
}
