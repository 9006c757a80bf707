// Step 10, where lists are longer than the cap: one workgroup a cluster. Its strongest lights are listed, in Hilbert order;
// the rest is folded into a node for each octant of directions, behind the list.
//
// lavapipe reads and writes shared memory lane by lane, whatever the lanes want of it: sums stay in registers until the end.
// It ends an invocation's loops after 65,535 iterations in all, of which each loop takes one to end: a million lights are 1,024
// batches of 15 to count and of 41 to take, and src/passes/cluster.rs has invocations for as many.
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

layout(local_size_x_id = 46) in;
#define LANES gl_WorkGroupSize.x
#define MOST_LANES FOLD_LANES
#include "cluster/lane_sums.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;

const vec3 MEAN_OF_RGB = vec3(1.0 / 3.0);

// Of a strength's bits: exponent and three of the mantissa.
const uint BIN_SHIFT = 20u;
const uint BINS = 2048u;
// Lights of an iteration that counts them.
const uint UNROLLED = 4u;

Cluster here;
Cluster parent;

#include "cluster/fold_points.glsl"
#include "cluster/fold_batch.glsl"
#include "cluster/fold_list.glsl"
#include "cluster/fold_sums.glsl"
#include "cluster/fold_nodes.glsl"

uint bin_of(float strength) { return min(floatBitsToUint(strength) >> BIN_SHIFT, BINS - 1u); }

float strength_of(uint light) {
    Beam beam = beam_of(light);
    precise float sum = 0.0;
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        vec3 d;
        float d2;
        sum += falloff_at(beam, points[k], d, d2);
    }
    return strength(beam, sum);
}

// Counts the lights of each bin in `words`; which is the highest.
uint count_bins(uint id) {
    uint lane = gl_LocalInvocationIndex;
    for (uint i = lane; i < BINS / 4u; i += LANES) words[i] = uvec4(0u);
    if (lane == 0u) highest = 0u;
    barrier();
    uint own = 0u;
    uint groups = parent_groups(parent);
    for (uint first = 0u; first < groups; first += batch_step()) {
        uint count = load_batch(id, first);
        for (uint begin = 0u; begin < count; begin += UNROLLED * LANES) {
            [[unroll]] for (uint j = 0u; j < UNROLLED; ++j) {
                uint i = begin + j * LANES + lane;
                uint bin = bin_of(strength_of(batch_light(first, i, count)));
                if (i < count) atomicAdd(words[bin / 4u][bin % 4u], 1u);
                own = i < count ? max(own, bin) : own;
            }
        }
    }
    atomicMax(highest, own);
    barrier();
    return highest;
}

// The bin of the weakest lights kept, and how many of it are.
uvec2 threshold_of(uint cap, uint bin) {
    uint above = 0u;
    uint own = words[bin / 4u][bin % 4u];
    while (bin > 0u && above + own < cap) {
        above += own;
        --bin;
        own = words[bin / 4u][bin % 4u];
    }
    return uvec2(bin, cap - above);
}

// Lists the batch's lights above the threshold, and as many in its bin as there is room for; folds the others. `left`: room
// in that bin, and in all.
void take(uint first, uint count, uint threshold, inout uvec2 left) {
    uint lane = gl_LocalInvocationIndex;
    for (uint begin = 0u; begin < count; begin += LANES) {
        uint i = begin + lane;
        uint light = batch_light(first, i, count);
        Beam beam = beam_of(light);
        see(beam);
        float value = strength(beam, seen.sum);
        uint bin = bin_of(value);
        bool is_above = i < count && bin > threshold;
        bool is_tied = i < count && bin == threshold;
        uvec4 sums = lane_sums(uvec2(uint(is_above), uint(is_tied)));
        uint rank = sums.x + min(sums.y, left.x);
        // The threshold leaves as much as there is room for; should the two disagree, what is too much is folded.
        bool is_listed = (is_above || (is_tied && sums.y < left.x)) && rank < left.y;
        if (is_listed) waiting[waiting_count + rank] = light;
        uint taken = min(sums.z + min(sums.w, left.x), left.y);
        waiting_count += taken;
        left -= uvec2(min(sums.w, left.x), taken);
        total += value;
        fold(beam, i < count && !is_listed);
    }
    flush_texels();
}

void main() {
    uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (workgroup >= counters.overflowed) return;
    uint id = clusters[workgroup].folded;
    here = clusters[id];
    parent = clusters[frame.cluster_capacity + here.parent];
    begin_list(here.list, (frame.max_list + 3u) / 4u);
    if (end + FOLD_ROOM > frame.list_capacity) return;
    load_points(here);
    uint highest_bin = count_bins(id);
    uvec2 threshold = threshold_of(frame.max_list, highest_bin);
    begin_sums();
    uvec2 left = uvec2(threshold.y, frame.max_list);
    uint groups = parent_groups(parent);
    for (uint first = 0u; first < groups; first += batch_step()) {
        uint count = load_batch(id, first);
        take(first, count, threshold.x, left);
    }
    end_list();
    write_nodes(id, end);
}
