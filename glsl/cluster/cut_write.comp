// Step 13: the cuts, four entries a texel, padded with the null node and the null light.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/moments.glsl"
#include "lib/math.glsl"
#include "lib/cut.glsl"
#include "lib/cluster.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) writeonly uniform uimage2DArray light_lists;

// A list on its way into texels.
struct Writer {
    uvec4 four;
    uint written;
    uint texel;
    uint end;
};

void append(inout Writer w, uint entry) {
    uint slot = w.written & 3u;
    // Selects, not four[slot]: a dynamic index would put the vector in memory.
    w.four = uvec4(slot == 0u ? entry : w.four.x, slot == 1u ? entry : w.four.y, slot == 2u ? entry : w.four.z, entry);
    ++w.written;
    if (slot == 3u && w.texel < w.end) imageStore(light_lists, list_texel(w.texel++), w.four);
}

void finish(inout Writer w, uint null) {
    while (w.texel < w.end) append(w, null);
}

Writer nodes;
Writer roots;
Writer leaves;
#define ON_NODE(index, error) append(nodes, index);
#define ON_ROOT(index) append(roots, index);
#define ON_LEAF(first) append(leaves, first);
#include "cluster/cut.glsl"

void main() {
    uint id = cluster_here();
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    // Numbers that no cluster took, which would walk the whole tree; and darkness.
    if (clusters[id].cut_nodes + clusters[id].cut_roots + clusters[id].cut_leaves == 0u) return;
    uint node_end = clusters[id].cut + (clusters[id].cut_nodes + 3u) / 4u;
    uint root_end = node_end + (clusters[id].cut_roots + 3u) / 4u;
    uint leaf_end = root_end + (clusters[id].cut_leaves + 3u) / 4u;
    if (leaf_end > frame.list_capacity) return;
    nodes = Writer(uvec4(0u), 0u, clusters[id].cut, node_end);
    roots = Writer(uvec4(0u), 0u, node_end, root_end);
    leaves = Writer(uvec4(0u), 0u, root_end, leaf_end);
    // One root and nothing else is the whole tree, or all of it that is not dark.
    if (clusters[id].cut_nodes + clusters[id].cut_leaves == 0u && clusters[id].cut_roots == 1u) {
        append(roots, 0u);
        finish(roots, frame.moment_nodes);
        return;
    }
    uint visits = 0u;
    cut(clusters[id].lower, clusters[id].upper, clusters[id].cut_limit, visits);
    finish(nodes, frame.moment_nodes);
    finish(roots, frame.moment_nodes);
    finish(leaves, frame.light_count);
}
