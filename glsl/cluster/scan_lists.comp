// Step 8: where each list lies, and what the lists add up to.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };

shared uint longest[SCAN_GROUP];

// Whether step 10 makes the list: it is longer than the cap, or its parent's is not of lights.
bool folds(uint id) {
    // Where parents have no room yet, the frame is rendered again.
    if (clusters[id].parent >= frame.parent_capacity) return false;
    uint kind = clusters[frame.cluster_capacity + clusters[id].parent].reaching >> PARENT_COUNT_BITS;
    return clusters[id].reaching > frame.max_list || kind != 0u;
}

uint texels_of(uint reaching) {
    return (min(reaching, frame.max_list) + 3u) / 4u + (reaching > frame.max_list ? FOLD_NODES * FOLD_TEXELS : 0u);
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 range = chunk(min(counters.clusters, frame.cluster_capacity));
    uint texels = 0u;
    uint entries = 0u;
    uint overflowed = 0u;
    uint folded = 0u;
    uint folding = 0u;
    longest[lane] = 0u;
    for (uint id = range.x; id < range.y; ++id) {
        uint reaching = clusters[id].reaching;
        uint kept = min(reaching, frame.max_list);
        texels += texels_of(reaching);
        entries += kept;
        overflowed += uint(reaching > kept);
        // A sum of so many chunks stays within 32 bits.
        folded = min(folded + reaching - kept, ~0u / SCAN_GROUP);
        folding += uint(folds(id));
        longest[lane] = max(longest[lane], reaching);
    }
    uint total;
    uint texel = frame.list_texels + exclusive_sum(texels, total);
    for (uint id = range.x; id < range.y; ++id) {
        clusters[id].list = texel;
        texel += texels_of(clusters[id].reaching);
    }
    if (lane == 0u) {
        counters.list_texels = frame.list_texels + total;
        counters.longest = 0u;
        for (uint i = 0u; i < SCAN_GROUP; ++i) counters.longest = max(counters.longest, longest[i]);
    }
    barrier();
    uint next = exclusive_sum(folding, total);
    for (uint id = range.x; id < range.y; ++id) {
        if (folds(id)) clusters[next++].folded = id;
    }
    if (lane == 0u) {
        counters.folding = total;
        counters.folds_x = min(total, MAX_GROUPS);
        counters.folds_y = (total + MAX_GROUPS - 1u) / MAX_GROUPS;
    }
    barrier();
    exclusive_sum(entries, total);
    if (lane == 0u) counters.entries = total;
    barrier();
    exclusive_sum(overflowed, total);
    if (lane == 0u) counters.overflowed = total;
    barrier();
    exclusive_sum(folded, total);
    if (lane == 0u) counters.folded = total;
}
