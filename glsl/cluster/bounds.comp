// Step 3: each pixel's cluster id, and each cluster's bounds: the box of the samples in it, not of the froxel.
// (many lights at 16 px: 54 pairs a pixel with these bounds, 87 with the froxel's.)
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

layout(local_size_x = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_CLUSTER_IDS_OUT, r32ui) writeonly uniform uimage2D cluster_ids;
layout(set = SET_frame, binding = FRAME_TILES, std430) readonly buffer TileBlock { Tile tiles[]; };
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) writeonly buffer ClusterBlock { Cluster clusters[]; };

// Relative to the view depth: above what interpolating the position and reconstructing it from depth can differ by,
// below a hundredth of a cluster.
const float PAD = 1e-4;

shared uint slices[SLICE_WORDS];
shared uint below[SLICE_WORDS];  // occupied slices in lower words
shared uint ranks[TILE_PIXELS];
shared vec4 samples[TILE_PIXELS];  // world position, view depth

// Rank of the pixel's slice among the tile's, its sample kept; NO_CLUSTER where no surface is.
uint rank_of(uvec2 pixel, uint index, uint count) {
    float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
    if (!(depth > 0.0)) return NO_CLUSTER;
    float z = view_depth(frame, depth);
    uint slice = slice_of(frame, z);
    uint word = slice >> 5;
    uint rank = below[word] + uint(bitCount(slices[word] & ((1u << (slice & 31u)) - 1u)));
    samples[index] = vec4(world_position(frame, vec2(pixel) + 0.5, z), z);
    // Step 1 took the same logarithm in another pipeline, where it may have rounded to another slice: the sample then
    // joins a neighbour, whose bounds follow it, but never the next tile's first cluster.
    return min(rank, count - 1u);
}

void write_bounds(uint id, uint rank) {
    vec3 lower = vec3(1e38);
    vec3 upper = vec3(-1e38);
    float farthest = 0.0;
    uint pixels = 0u;
    for (uint i = 0u; i < TILE_PIXELS; ++i) {
        if (ranks[i] != rank) continue;
        lower = min(lower, samples[i].xyz);
        upper = max(upper, samples[i].xyz);
        farthest = max(farthest, samples[i].w);
        ++pixels;
    }
    vec3 eye = abs(frame.eye);
    float pad = PAD * (farthest + 0.1 * max(eye.x, max(eye.y, eye.z)));
    clusters[id].lower = lower - pad;
    clusters[id].upper = upper + pad;
    clusters[id].pixels = pixels;
    // Until step 5 counts, which it does only where there are lights for lists.
    clusters[id].reaching = 0u;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint tile = gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x;
    uint first = tiles[tile].first;
    uint count = tiles[tile].count;
    if (lane < SLICE_WORDS) {
        slices[lane] = tiles[tile].slices[lane];
        below[lane] = 0u;
        for (uint word = 0u; word < lane; ++word) below[lane] += uint(bitCount(tiles[tile].slices[word]));
    }
    barrier();

    for (uint row = 0u; row < TILE_SIZE; ++row) {
        uint index = row * TILE_SIZE + lane;
        uvec2 pixel = gl_WorkGroupID.xy * TILE_SIZE + uvec2(lane, row);
        ranks[index] = NO_CLUSTER;
        if (any(greaterThanEqual(pixel, frame.size))) continue;
        uint rank = rank_of(pixel, index, count);
        ranks[index] = rank;
        imageStore(cluster_ids, ivec2(pixel), uvec4(rank == NO_CLUSTER ? NO_CLUSTER : first + rank));
    }
    barrier();

    // One invocation a cluster, so no atomics.
    for (uint rank = lane; rank < count; rank += TILE_SIZE) {
        if (first + rank < frame.cluster_capacity) write_bounds(first + rank, rank);
    }
}
