// Step 7: which of its parent's lights reach each cluster. An invocation tests each light against SIBLINGS clusters, for on
// lavapipe a light's fetch costs as much as four tests.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"
#include "lib/parent.glsl"
#include "cluster/reach.glsl"
#include "cluster/members.glsl"

// As many clusters a workgroup as the other steps have.
layout(local_size_x = LINEAR_GROUP / SIBLINGS) in;
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };

vec3 lower[SIBLINGS];
vec3 upper[SIBLINGS];

void load_siblings(uint first, uint count) {
    [[unroll]] for (uint i = 0u; i < SIBLINGS; ++i) {
        // No light reaches a box turned inside out.
        lower[i] = i < count ? clusters[first + i].lower : vec3(1e18);
        upper[i] = i < count ? clusters[first + i].upper : vec3(-1e18);
    }
}

uvec4 group_hits(Cluster parent, uint group) {
    uint kind = parent_kind(parent);
    uint leaf = leaf_of(parent, group) * LEAF_LIGHTS;
    uvec4 hits = uvec4(0u);
    [[unroll]] for (uint i = 0u; i < LEAF_LIGHTS; i += 4u) {
        uvec4 four = imageLoad(light_lists, list_texel(parent.list + (group * LEAF_LIGHTS + i) / 4u));
        four = kind == OF_LIGHTS ? four : leaf + uvec4(i, i + 1u, i + 2u, i + 3u);
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            vec4 place = light_place(four[j]);
            [[unroll]] for (uint k = 0u; k < SIBLINGS; ++k) {
                hits[k] |= uint(reaches(place, lower[k], upper[k])) << (i + j);
            }
        }
    }
    uint left = kind == OF_LIGHTS ? parent_entries(parent) - group * LEAF_LIGHTS : frame.direct_begin - leaf;
    return hits & first_bits(left);
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint first = group * LINEAR_GROUP + gl_LocalInvocationIndex * SIBLINGS;
    if (first >= min(counters.clusters, frame.cluster_capacity)) return;
    uint number = clusters[first].parent;
    // The frame is rendered again with room for all parents.
    if (number >= frame.parent_capacity) return;
    Cluster parent = clusters[frame.cluster_capacity + number];
    uint siblings = parent.children - (first - parent.parent);
    load_siblings(first, siblings);
    uint groups = parent_groups(parent);
    uint texel = sibling_masks(first);
    uvec4 reaching = uvec4(0u);
    for (uint i = 0u; i < groups; ++i) {
        uvec4 hits = group_hits(parent, i);
        reaching += uvec4(bitCount(hits));
        if (parent_kind(parent) == OF_LIGHTS) imageStore(light_lists, list_texel(texel + i), hits);
    }
    [[unroll]] for (uint i = 0u; i < SIBLINGS; ++i) {
        clusters[first + i].reaching = reaching[i];
        // Numbers that no cluster took may hold those of another frame.
        uvec2 pixels = i < siblings ? clusters[first + i].pixels : uvec2(0u);
        clusters[first + i].pixels = pixels;
        clusters[first + i].pixel_count = uint(bitCount(pixels.x) + bitCount(pixels.y));
    }
}
