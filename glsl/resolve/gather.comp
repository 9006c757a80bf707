// Work lists of the resolve: one workgroup a variant, which scans all clusters for those that have pixels of it. A cluster
// of r rows of lanes goes to the pipeline whose invocations shade r pixels each; of more than that shades most, in two
// halves. So a light's texels are fetched once for as many pixels as there are, and hardly a lane shades none.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(constant_id = 46) const uint LANES = 8u;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_resolve, binding = RESOLVE_WORK, std430) buffer WorkBlock {
    ResolveDispatch dispatches[RESOLVE_VARIANTS * RESOLVE_PIXELS];
    uint entries[];
};

// Rows of the cluster's first and second entry; 0: no such entry.
uvec2 rows_of(uint id, uint variant) {
    Cluster cluster = clusters[id];
    // A list that is empty lights nothing.
    if ((cluster.variants >> variant & 1u) == 0u || cluster.reaching == 0u) return uvec2(0u);
    uint pixels = uint(bitCount(cluster.pixels.x) + bitCount(cluster.pixels.y));
    uint rows = (pixels + LANES - 1u) / LANES;
    uint second = rows > RESOLVE_PIXELS ? rows / 2u : 0u;
    return uvec2(rows - second, second);
}

void main() {
    uint variant = gl_WorkGroupID.x;
    uvec2 range = chunk(min(counters.clusters, frame.cluster_capacity));
    uint counts[RESOLVE_PIXELS + 1u];
    for (uint i = 0u; i <= RESOLVE_PIXELS; ++i) counts[i] = 0u;
    for (uint id = range.x; id < range.y; ++id) {
        uvec2 rows = rows_of(id, variant);
        for (uint i = 1u; i <= RESOLVE_PIXELS; ++i) counts[i] += uint(rows.x == i) + uint(rows.y == i);
    }
    // Up to two entries a cluster and variant.
    uint first = variant * 2u * frame.cluster_capacity;
    uint next[RESOLVE_PIXELS + 1u];
    for (uint i = 1u; i <= RESOLVE_PIXELS; ++i) {
        uint total;
        next[i] = first + exclusive_sum(counts[i], total);
        if (gl_LocalInvocationIndex == 0u) {
            uint rows = (total + MAX_GROUPS - 1u) / MAX_GROUPS;
            dispatches[variant * RESOLVE_PIXELS + i - 1u] =
                    ResolveDispatch(min(total, MAX_GROUPS), rows, 1u, first, total);
        }
        first += total;
        barrier();
    }
    for (uint id = range.x; id < range.y; ++id) {
        uvec2 rows = rows_of(id, variant);
        for (uint i = 1u; i <= RESOLVE_PIXELS; ++i) {
            if (rows.x == i) entries[next[i]++] = id;
            if (rows.y == i) entries[next[i]++] = id | RESOLVE_SECOND;
        }
    }
}
