// Step 8: where each list lies, and what the lists add up to.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };

shared uint longest[SCAN_GROUP];

// Lights that reach a cluster; where parents have no room yet, none are known, and the frame is rendered again.
uint reaching(uint id) { return clusters[id].parent < frame.parent_capacity ? clusters[id].reaching : 0u; }

uint texels_of(uint lights) {
    return (min(lights, frame.max_list) + 3u) / 4u + (lights > frame.max_list ? FOLD_ROOM : 0u);
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 range = chunk(min(counters.clusters, frame.cluster_capacity));
    uint texels = 0u;
    uint entries = 0u;
    uint overflowed = 0u;
    uint folded = 0u;
    longest[lane] = 0u;
    for (uint id = range.x; id < range.y; ++id) {
        uint lights = reaching(id);
        uint kept = min(lights, frame.max_list);
        texels += texels_of(lights);
        entries += kept;
        overflowed += uint(lights > kept);
        // A sum of so many chunks stays within 32 bits.
        folded = min(folded + lights - kept, ~0u / SCAN_GROUP);
        longest[lane] = max(longest[lane], lights);
    }
    uint total;
    uint texel = frame.list_texels + exclusive_sum(texels, total);
    for (uint id = range.x; id < range.y; ++id) {
        clusters[id].list = texel;
        texel += texels_of(reaching(id));
    }
    if (lane == 0u) {
        counters.list_texels = frame.list_texels + total;
        counters.longest = 0u;
        for (uint i = 0u; i < SCAN_GROUP; ++i) counters.longest = max(counters.longest, longest[i]);
    }
    barrier();
    uint next = exclusive_sum(overflowed, total);
    for (uint id = range.x; id < range.y; ++id) {
        if (reaching(id) > frame.max_list) clusters[next++].folded = id;
    }
    if (lane == 0u) {
        counters.overflowed = total;
        counters.folds_x = min(total, MAX_GROUPS);
        counters.folds_y = (total + MAX_GROUPS - 1u) / MAX_GROUPS;
    }
    barrier();
    exclusive_sum(entries, total);
    if (lane == 0u) counters.entries = total;
    barrier();
    exclusive_sum(folded, total);
    if (lane == 0u) counters.folded = total;
}
