// Step 6: the lights that reach each parent. One workgroup a parent: its invocations walk down the tree together, testing as
// many nodes of a level, then lights, a leaf each. Invocation after invocation, what they list is in Hilbert order, however
// many they are.
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

// Invocations: 8 to MOST_LANES, so that the nodes below one are shared out evenly.
layout(local_size_x_id = 46) in;
#define LANES gl_WorkGroupSize.x
#define MOST_LANES TOP_LEAVES
#include "cluster/lane_sums.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

// Leaves that a list holds: with as many as lights, shared memory would be more than the 16 KiB of every device.
const uint LEAF_ROOM = PARENT_ROOM / 2u;

// Levels of the tree: what it says of them is in src/light_tree.rs.
const uint CROWNS = 0u;
const uint TOPS = 1u;
const uint LEAVES = 2u;

shared vec3 lowers[MOST_LANES];
shared vec3 uppers[MOST_LANES];
// Of each level, below one node: those that the box meets.
shared uint met[3u * TOP_LEAVES];
shared uint lights[PARENT_ROOM];
shared uint leaves[LEAF_ROOM];

vec3 lower = vec3(1e38);
vec3 upper = vec3(-1e38);
uvec2 found = uvec2(0u);  // lights, leaves

// The box of all children.
void bound(uint first, uint count) {
    uint lane = gl_LocalInvocationIndex;
    uint end = min(first + count, frame.cluster_capacity);
    for (uint id = first + lane; id < end; id += LANES) {
        lower = min(lower, clusters[id].lower);
        upper = max(upper, clusters[id].upper);
    }
    lowers[lane] = lower;
    uppers[lane] = upper;
    barrier();
    [[unroll]] for (uint i = 0u; i < LANES; ++i) {
        lower = min(lower, lowers[i]);
        upper = max(upper, uppers[i]);
    }
}

// Notes the nodes of a level whose bits are set, from `begin` on, for all invocations; returns how many they have.
uint note(uint level, uint begin, uint bits) {
    uvec4 sum = lane_sums(uvec2(bitCount(bits), 0u));
    for (uint at = level * TOP_LEAVES + sum.x; bits != 0u; bits &= bits - 1u) met[at++] = begin + uint(findLSB(bits));
    barrier();
    return sum.z;
}

// Notes which nodes of a level, TOP_LEAVES of them at most from number `first` on, the box meets.
uint note_met(uint level, uint level_at, uint first, uint end) {
    uint each = TOP_LEAVES / LANES;
    uint begin = first + gl_LocalInvocationIndex * each;
    uint bits = 0u;
    // Not unrolled: most scenes have few of them.
    for (uint i = 0u; i < each && begin + i < end; ++i) {
        bits |= uint(overlap(node_at(level_at + begin + i), lower, upper)) << i;
    }
    return note(level, begin, bits);
}

// The same of all leaves below a node.
uint note_leaves(uint leaves_at, uint first) {
    uint begin = first + gl_LocalInvocationIndex * (TOP_LEAVES / LANES);
    uint bits = 0u;
    [[unroll]] for (uint i = 0u; i < TOP_LEAVES / LANES; ++i) {
        bits |= uint(overlap(node_at(leaves_at + begin + i), lower, upper)) << i;
    }
    return note(LEAVES, begin, bits);
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

// Whether what is found needs no more: a parent that will be split needs no list, and with too many leaves none is made.
bool full() { return found.x > PARENT_ROOM && (counters.first_parent == 0u || found.y > LEAF_ROOM); }

void visit_leaves(uint count) {
    for (uint first = 0u; first < count && !full(); first += LANES) {
        uint at = first + gl_LocalInvocationIndex;
        uint leaf = at < count ? met[LEAVES * TOP_LEAVES + at] : 0u;
        uint light = leaf * LEAF_LIGHTS;
        append(leaf, leaf_hits(light, at < count ? frame.direct_begin - light : 0u, lower, upper));
    }
}

void walk() {
    uint tops = frame.top_nodes;
    uint crowns = (tops + TOP_LEAVES - 1u) / TOP_LEAVES;
    for (uint first = 0u; first < crowns && !full(); first += TOP_LEAVES) {
        uint met_crowns = note_met(CROWNS, 0u, first, crowns);
        for (uint i = 0u; i < met_crowns && !full(); ++i) {
            uint met_tops = note_met(TOPS, crowns, met[CROWNS * TOP_LEAVES + i] * TOP_LEAVES, tops);
            for (uint j = 0u; j < met_tops && !full(); ++j) {
                visit_leaves(note_leaves(crowns + tops, met[TOPS * TOP_LEAVES + j] * TOP_LEAVES));
            }
        }
    }
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
        for (uint at = 4u * lane; at < end; at += 4u * LANES) {
            imageStore(light_lists, list_texel(texel + at / 4u), four_lights(at, found.x));
        }
    } else if (found.y <= LEAF_ROOM) {
        for (uint at = 4u * lane; at < found.y; at += 4u * LANES) {
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
    uint parent = counters.first_parent + gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (parent >= min(counters.parents, frame.parent_capacity)) return;
    uint index = frame.cluster_capacity + parent;
    bound(clusters[index].parent, clusters[index].children);
    walk();
    write_list(clusters[index].list);
    if (gl_LocalInvocationIndex == 0u) clusters[index].reaching = entries();
}
