// Step 1: the occupied slices of each tile, by quadrant where clusters are split. One workgroup a tile, one invocation a
// column: on lavapipe that is one vector, and a barrier costs nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

layout(local_size_x = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_CLUSTER_IDS_OUT, r32ui) writeonly uniform uimage2D cluster_ids;
layout(set = SET_frame, binding = FRAME_TILES, std430) writeonly buffer TileBlock { Tile tiles[]; };

shared uint words[TILE_WORDS];

void main() {
    uint lane = gl_LocalInvocationIndex;
    for (uint i = lane; i < TILE_WORDS; i += TILE_SIZE) words[i] = 0u;
    barrier();

    for (uint row = 0u; row < TILE_SIZE; ++row) {
        uvec2 pixel = gl_WorkGroupID.xy * TILE_SIZE + uvec2(lane, row);
        if (any(greaterThanEqual(pixel, frame.size))) continue;
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        uint key = NO_CLUSTER;
        if (depth > 0.0) {
            uint slice = slice_of(frame, view_depth(frame, depth));
            uint quadrant = slice < frame.split_slice ? 0u : (row & 4u) >> 1 | lane >> 2;
            atomicOr(words[quadrant * SLICE_WORDS + (slice >> 5)], 1u << (slice & 31u));
            key = slice << 2 | quadrant;
        }
        // Step 4 puts the cluster's id in its place: taken again there, the logarithm could round to another slice.
        imageStore(cluster_ids, ivec2(pixel), uvec4(key));
    }
    barrier();

    uint tile = gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x;
    for (uint i = lane; i < TILE_WORDS; i += TILE_SIZE) tiles[tile].slices[i] = words[i];
}
