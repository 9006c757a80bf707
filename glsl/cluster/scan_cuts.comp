// Step 12: where each cut lies: behind the lists of lights with a range.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };

shared uint longest[SCAN_GROUP];

uint entries_of(uint id) { return clusters[id].cut_nodes + clusters[id].cut_roots + clusters[id].cut_leaves; }

uint texels_of(uint id) {
    return (clusters[id].cut_nodes + 3u) / 4u + (clusters[id].cut_roots + 3u) / 4u + (clusters[id].cut_leaves + 3u) / 4u;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 range = chunk(min(counters.clusters, frame.cluster_capacity));
    uint texels = 0u;
    uint entries = 0u;
    longest[lane] = 0u;
    for (uint id = range.x; id < range.y; ++id) {
        texels += texels_of(id);
        entries += entries_of(id);
        longest[lane] = max(longest[lane], entries_of(id));
    }
    // Without lists, step 8 has counted nothing: what comes before them does all the same.
    uint before = max(counters.list_texels, frame.list_texels);
    uint total;
    uint texel = before + exclusive_sum(texels, total);
    for (uint id = range.x; id < range.y; ++id) {
        clusters[id].cut = texel;
        texel += texels_of(id);
    }
    // Every invocation has read what lane 0 overwrites.
    memoryBarrierBuffer();
    barrier();
    if (lane == 0u) {
        counters.list_texels = before + total;
        for (uint i = 0u; i < SCAN_GROUP; ++i) counters.cut_longest = max(counters.cut_longest, longest[i]);
    }
    barrier();
    exclusive_sum(entries, total);
    if (lane == 0u) counters.cut_entries = total;
}
