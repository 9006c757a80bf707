// Step 6, second part: a parent whose list would be too long is split. Each SIBLINGS of its children get a parent of their
// own, behind the others, and these are gathered in turn. (A million lights at 320 × 180, where a pixel at 60 m is 0.4 m
// wide: without it every light is tested against most clusters.)
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/parent.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };

// Parents that come from parent number `index`.
uint parts_of(uint index) {
    uint at = frame.cluster_capacity + index;
    uint kind = clusters[at].reaching >> PARENT_COUNT_BITS;
    return kind == OF_LIGHTS ? 0u : (clusters[at].children + SIBLINGS - 1u) / SIBLINGS;
}

// Ids that no child took get it too: with the crowded parent they would count as clusters to be folded.
void write_part(uint parent, uint first, uint count) {
    for (uint id = first; id < min(first + SIBLINGS, frame.cluster_capacity); ++id) clusters[id].parent = parent;
    // Its children are left alone, and the frame is rendered again with room for it.
    if (parent >= frame.parent_capacity) return;
    uint list = frame.parent_texels + parent * (PARENT_ROOM / 4u);
    clusters[frame.cluster_capacity + parent] = Cluster(vec3(0.0), 0u, vec3(0.0), list, uvec2(0u), 0u, 0u, first, count, 0u,
                                                        0.0, 0u, 0u, 0u, 0u, 0.0, 0.0, 0u, 0u);
}

void main() {
    uint all = counters.parents;
    uvec2 range = chunk(min(all, frame.parent_capacity));
    uint parts = 0u;
    for (uint i = range.x; i < range.y; ++i) parts += parts_of(i);
    uint total;
    uint next = all + exclusive_sum(parts, total);
    for (uint i = range.x; i < range.y; ++i) {
        uint first = clusters[frame.cluster_capacity + i].parent;
        uint children = clusters[frame.cluster_capacity + i].children;
        uint end = parts_of(i) * SIBLINGS;
        for (uint child = 0u; child < end; child += SIBLINGS) {
            write_part(next++, first + child, min(children - child, SIBLINGS));
        }
    }
    // Every invocation has read what lane 0 overwrites.
    memoryBarrierBuffer();
    barrier();
    if (gl_LocalInvocationIndex != 0u) return;
    uint room = frame.parent_capacity - min(all, frame.parent_capacity);
    uint parents = min(total, room);
    counters.parents = all + total;
    counters.first_parent = all;
    counters.parents_x = min(parents, MAX_GROUPS);
    counters.parents_y = (parents + MAX_GROUPS - 1u) / MAX_GROUPS;
}
