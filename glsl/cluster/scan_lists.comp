// Step 6: where each list lies, and what the lists add up to.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };

shared uint longest[SCAN_GROUP];

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 range = chunk(min(counters.clusters, frame.cluster_capacity));
    uint texels = 0u;
    uint entries = 0u;
    uint overflowed = 0u;
    uint dropped = 0u;
    longest[lane] = 0u;
    for (uint id = range.x; id < range.y; ++id) {
        uint reaching = clusters[id].reaching;
        uint kept = min(reaching, frame.max_list);
        texels += (kept + 3u) / 4u;
        entries += kept;
        overflowed += uint(reaching > kept);
        dropped += reaching - kept;
        longest[lane] = max(longest[lane], reaching);
    }
    uint total;
    // Masks of area lights come first.
    uint masks = frame.cluster_capacity * frame.area_texels;
    uint texel = masks + exclusive_sum(texels, total);
    for (uint id = range.x; id < range.y; ++id) {
        clusters[id].list = texel;
        texel += (min(clusters[id].reaching, frame.max_list) + 3u) / 4u;
    }
    if (lane == 0u) {
        counters.list_texels = masks + total;
        counters.longest = 0u;
        for (uint i = 0u; i < SCAN_GROUP; ++i) counters.longest = max(counters.longest, longest[i]);
    }
    barrier();
    exclusive_sum(entries, total);
    if (lane == 0u) counters.entries = total;
    barrier();
    exclusive_sum(overflowed, total);
    if (lane == 0u) counters.overflowed = total;
    barrier();
    exclusive_sum(dropped, total);
    if (lane == 0u) counters.dropped = total;
}
