// Set 0: clusters and their light lists as the shading reads them.
#ifndef BIND_LISTS_GLSL
#define BIND_LISTS_GLSL

layout(set = SET_frame, binding = FRAME_CLUSTER_IDS) uniform utexture2D cluster_ids;
layout(set = SET_frame, binding = FRAME_LISTS) uniform utexture2DArray light_lists;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };

struct LightList {
    uint texel;  // first texel
    uint count;  // lights
    uint nodes;  // of lights that are folded, behind the list
};

// The cluster that the pixel's surface lies in. The id was stored by the cluster pass: computing it here again could
// round to another slice.
uint cluster_at(ivec2 pixel) { return texelFetch(cluster_ids, pixel, 0).r; }

LightList list_of(uint id) {
    // Past the capacity the frame is rendered again with more room; until then nothing out of bounds is read.
    if (id >= frame.cluster_capacity) return LightList(0u, 0u, 0u);
    uint reaching = clusters[id].reaching;
    uint count = min(reaching, frame.max_list);
    uint nodes = reaching > count ? FOLD_NODES : 0u;
    uint texel = clusters[id].list;
    bool fits = texel + (count + 3u) / 4u + nodes * FOLD_TEXELS <= frame.list_capacity;
    return fits ? LightList(texel, count, nodes) : LightList(0u, 0u, 0u);
}

LightList list_at(ivec2 pixel) { return list_of(cluster_at(pixel)); }

// Four indices of a list; past its end they name the null light.
uvec4 list_indices(uint texel) { return texelFetch(light_lists, list_texel(texel), 0); }

// A cluster's cut: texels of nodes, of roots from `roots` on, of leaves from `leaves` on.
struct Cut {
    uint texel;
    uint roots;
    uint leaves;
    uint end;
    float power;  // Σ power/d² at the cluster
    float limit;  // largest error of a node, in its units
};

Cut cut_at(ivec2 pixel) {
    uint id = cluster_at(pixel);
    if (id >= frame.cluster_capacity) return Cut(0u, 0u, 0u, 0u, 0.0, 0.0);
    uint texel = clusters[id].cut;
    uint roots = texel + (clusters[id].cut_nodes + 3u) / 4u;
    uint leaves = roots + (clusters[id].cut_roots + 3u) / 4u;
    uint end = leaves + (clusters[id].cut_leaves + 3u) / 4u;
    // As with lists.
    if (end > frame.list_capacity) return Cut(0u, 0u, 0u, 0u, 0.0, 0.0);
    return Cut(texel, roots, leaves, end, clusters[id].cut_power, clusters[id].cut_limit);
}

// Nodes and lights without a range that a pixel evaluates; what it opens counts as one.
uint unranged_count(ivec2 pixel) {
    if (frame.moment_nodes == 0u) return frame.light_count - frame.direct_begin;
    uint id = cluster_at(pixel);
    if (id >= frame.cluster_capacity) return 0u;
    return clusters[id].cut_nodes + clusters[id].cut_roots + MOMENT_LEAF * clusters[id].cut_leaves;
}

// 32 area lights from number 32 · word on: a bit for those that reach the cluster.
uint area_mask(uint cluster, uint word) {
    if (cluster >= frame.cluster_capacity) return 0u;
    return texelFetch(light_lists, list_texel(cluster * frame.area_texels + (word >> 2)), 0)[word & 3u];
}

// Area lights that a pixel evaluates.
uint area_count(ivec2 pixel) {
    if (frame.area_texels == 0u) return frame.area_lights;
    uint count = 0u;
    uint cluster = cluster_at(pixel);
    for (uint word = 0u; word < 4u * frame.area_texels; ++word) {
        count += uint(bitCount(area_mask(cluster, word)));
    }
    return count;
}

#endif
