// Step 7: the lists, four indices a texel, padded with the null light so that the shading loop has no tail.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

uint written = 0u;
uint kept = 0u;
uint texel = 0u;
uvec4 four = uvec4(0u);

void append(uint light) {
    uint slot = written & 3u;
    // Selects, not four[slot]: a dynamic index would put the vector in memory.
    four = uvec4(slot == 0u ? light : four.x, slot == 1u ? light : four.y, slot == 2u ? light : four.z, light);
    ++written;
    if (slot == 3u) imageStore(light_lists, list_texel(texel++), four);
}

void append_all(uint first, uint hits) {
    // At most max_list iterations in all, well below lavapipe's limit. Not max_list itself: step 5 made room for `kept`.
    for (; hits != 0u && written < kept; hits &= hits - 1u) append(first + uint(findLSB(hits)));
}

#define ON_HITS(first, hits) append_all(first, hits);
#include "cluster/reach.glsl"

void main() {
    uint id = cluster_here();
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    texel = clusters[id].list;
    kept = min(clusters[id].reaching, frame.max_list);
    if (texel + (kept + 3u) / 4u > frame.list_capacity) return;
    visit_lights(clusters[id].lower, clusters[id].upper);
    // Where this pipeline rounds a distance up that step 5's rounded down, more than a tail is left: none of it may stay
    // undefined.
    uint end = clusters[id].list + (kept + 3u) / 4u;
    while (texel < end) append(frame.light_count);
}
