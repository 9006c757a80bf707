// Step 6: the lights that reach each parent. One workgroup a parent: its invocations test top nodes, then the leaves of those
// that it meets, then lights, a leaf each. Invocation after invocation, what they list is in Hilbert order.
//
// lavapipe ends an invocation's loops after 65,535 iterations in all: a million lights have 32,768 leaves, eight to an
// iteration, and a leaf's lights are unrolled.
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

#define LANES GATHER_LANES
#include "cluster/lane_sums.glsl"

layout(local_size_x = GATHER_LANES) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

// Leaves of a top node that one invocation tests.
const uint LANE_LEAVES = TOP_LEAVES / GATHER_LANES;
// Leaves that a list holds: with as many as lights, shared memory would be more than the 16 KiB of every device.
const uint LEAF_ROOM = PARENT_ROOM / 2u;

shared vec3 lowers[GATHER_LANES];
shared vec3 uppers[GATHER_LANES];
shared uint tops[32u * GATHER_LANES];
shared uint met_leaves[TOP_LEAVES];
shared uint lights[PARENT_ROOM];
shared uint leaves[LEAF_ROOM];

vec3 lower = vec3(1e38);
vec3 upper = vec3(-1e38);
uvec2 found = uvec2(0u);  // lights, leaves

// The box of all children.
void bound(uint first, uint count) {
    uint lane = gl_LocalInvocationIndex;
    uint end = min(first + count, frame.cluster_capacity);
    for (uint id = first + lane; id < end; id += GATHER_LANES) {
        lower = min(lower, clusters[id].lower);
        upper = max(upper, clusters[id].upper);
    }
    lowers[lane] = lower;
    uppers[lane] = upper;
    barrier();
    [[unroll]] for (uint i = 0u; i < GATHER_LANES; ++i) {
        lower = min(lower, lowers[i]);
        upper = max(upper, uppers[i]);
    }
}

// Bits of the `count` nodes from `first` on that the box meets.
uint met_nodes(uint first, uint count) {
    uint met = 0u;
    for (uint i = 0u; i < count; ++i) met |= uint(overlap(node_at(first + i), lower, upper)) << i;
    return met;
}

// Lists the leaves of a top node that the box meets; returns how many.
uint list_leaves(uint top) {
    uint begin = top * TOP_LEAVES + gl_LocalInvocationIndex * LANE_LEAVES;
    uint met = 0u;
    [[unroll]] for (uint i = 0u; i < LANE_LEAVES; ++i) {
        met |= uint(overlap(node_at(frame.top_nodes + begin + i), lower, upper)) << i;
    }
    uvec4 sum = lane_sums(uvec2(bitCount(met), 0u));
    for (uint at = sum.x; met != 0u; met &= met - 1u) met_leaves[at++] = begin + uint(findLSB(met));
    barrier();
    return sum.z;
}

void append(uint leaf, uint hits) {
    uvec4 sum = lane_sums(uvec2(uint(bitCount(hits)), uint(hits != 0u)));
    uvec2 at = found + sum.xy;
    if (hits != 0u && at.y < LEAF_ROOM) leaves[at.y] = leaf;
    for (; hits != 0u && at.x < PARENT_ROOM; hits &= hits - 1u) {
        lights[at.x++] = leaf * LEAF_LIGHTS + uint(findLSB(hits));
    }
    found += sum.zw;
}

void visit_top(uint top) {
    uint count = list_leaves(top);
    for (uint first = 0u; first < count; first += GATHER_LANES) {
        uint at = first + gl_LocalInvocationIndex;
        uint leaf = at < count ? met_leaves[at] : 0u;
        uint light = leaf * LEAF_LIGHTS;
        append(leaf, leaf_hits(light, at < count ? frame.direct_begin - light : 0u, lower, upper));
    }
}

// Every invocation tests 32 top nodes after one another, which takes no barrier.
void visit_tops(uint first) {
    uint begin = first + 32u * gl_LocalInvocationIndex;
    uint met = met_nodes(begin, min(32u, frame.top_nodes - min(begin, frame.top_nodes)));
    uvec4 sum = lane_sums(uvec2(bitCount(met), 0u));
    for (uint at = sum.x; met != 0u; met &= met - 1u) tops[at++] = begin + uint(findLSB(met));
    barrier();
    for (uint i = 0u; i < sum.z; ++i) visit_top(tops[i]);
}

uvec4 four_lights(uint at, uint count) {
    uvec4 i = uvec4(at, at + 1u, at + 2u, at + 3u);
    uint none = frame.light_count;
    return uvec4(i.x < count ? lights[i.x] : none, i.y < count ? lights[i.y] : none, i.z < count ? lights[i.z] : none,
                 i.w < count ? lights[i.w] : none);
}

void write_list(uint texel) {
    barrier();
    uint lane = gl_LocalInvocationIndex;
    if (found.x <= PARENT_ROOM) {
        // All of the last group's: what lies past the end names the null light.
        uint end = (found.x + LEAF_LIGHTS - 1u) / LEAF_LIGHTS * LEAF_LIGHTS;
        for (uint at = 4u * lane; at < end; at += 4u * GATHER_LANES) {
            imageStore(light_lists, list_texel(texel + at / 4u), four_lights(at, found.x));
        }
    } else if (found.y <= LEAF_ROOM) {
        for (uint at = 4u * lane; at < found.y; at += 4u * GATHER_LANES) {
            uvec4 four = uvec4(leaves[at], leaves[at + 1u], leaves[at + 2u], leaves[at + 3u]);
            imageStore(light_lists, list_texel(texel + at / 4u), four);
        }
    }
}

uint entries() {
    if (found.x <= PARENT_ROOM) return found.x | OF_LIGHTS << PARENT_COUNT_BITS;
    if (found.y <= LEAF_ROOM) return found.y | OF_LEAVES << PARENT_COUNT_BITS;
    return (frame.direct_begin + LEAF_LIGHTS - 1u) / LEAF_LIGHTS | OF_ALL << PARENT_COUNT_BITS;
}

void main() {
    uint parent = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (parent >= min(counters.parents, frame.parent_capacity)) return;
    uint index = frame.cluster_capacity + parent;
    bound(clusters[index].parent, clusters[index].children);
    for (uint first = 0u; first < frame.top_nodes; first += 32u * GATHER_LANES) visit_tops(first);
    write_list(clusters[index].list);
    if (gl_LocalInvocationIndex == 0u) clusters[index].reaching = entries();
}
