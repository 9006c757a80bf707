// Set 0: clusters and their light lists as the shading reads them.
#ifndef BIND_LISTS_GLSL
#define BIND_LISTS_GLSL

layout(set = SET_frame, binding = FRAME_CLUSTER_IDS) uniform utexture2D cluster_ids;
layout(set = SET_frame, binding = FRAME_LISTS) uniform utexture2DArray light_lists;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) readonly buffer ClusterBlock { Cluster clusters[]; };

struct LightList {
    uint texel;  // first texel
    uint count;  // lights
};

// The list of the cluster that the pixel's surface lies in. The id was stored by the cluster pass: computing it here
// again could round to another slice.
LightList list_at(ivec2 pixel) {
    uint id = texelFetch(cluster_ids, pixel, 0).r;
    // Past the capacity the frame is rendered again with more room; until then nothing out of bounds is read.
    if (id >= frame.cluster_capacity) return LightList(0u, 0u);
    uint count = min(clusters[id].reaching, frame.max_list);
    uint texel = clusters[id].list;
    return LightList(texel, texel + (count + 3u) / 4u <= frame.list_capacity ? count : 0u);
}

// Four indices of a list; past its end they name the null light.
uvec4 list_indices(uint texel) { return texelFetch(light_lists, list_texel(texel), 0); }

#endif
