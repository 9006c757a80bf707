// Step 1: the occupied slices of each tile, by quadrant where clusters are split. One invocation a column, and as many tiles
// of a row a workgroup as it has columns for: on lavapipe one, which is one vector, so that a barrier costs nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

layout(local_size_x_id = 46) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_CLUSTER_IDS_OUT, r32ui) writeonly uniform uimage2D cluster_ids;
layout(set = SET_frame, binding = FRAME_TILES, std430) writeonly buffer TileBlock { Tile tiles[]; };

shared uint words[MOST_TILES * TILE_WORDS];

void main() {
    uint column = gl_LocalInvocationIndex % TILE_SIZE;
    uint first_word = gl_LocalInvocationIndex / TILE_SIZE * TILE_WORDS;
    uvec2 at = uvec2(gl_GlobalInvocationID.x / TILE_SIZE, gl_WorkGroupID.y);
    for (uint i = column; i < TILE_WORDS; i += TILE_SIZE) words[first_word + i] = 0u;
    barrier();

    for (uint row = 0u; row < TILE_SIZE; ++row) {
        uvec2 pixel = at * TILE_SIZE + uvec2(column, row);
        if (any(greaterThanEqual(pixel, frame.size))) continue;
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        uint key = NO_CLUSTER;
        if (depth > 0.0) {
            uint slice = slice_of(frame, view_depth(frame, depth));
            uint quadrant = slice < frame.split_slice ? 0u : (row & 4u) >> 1 | column >> 2;
            atomicOr(words[first_word + quadrant * SLICE_WORDS + (slice >> 5)], 1u << (slice & 31u));
            key = slice << 2 | quadrant;
        }
        // Step 4 puts the cluster's id in its place: taken again there, the logarithm could round to another slice.
        imageStore(cluster_ids, ivec2(pixel), uvec4(key));
    }
    barrier();

    if (at.x >= frame.tiles.x) return;
    uint tile = at.y * frame.tiles.x + at.x;
    for (uint i = column; i < TILE_WORDS; i += TILE_SIZE) tiles[tile].slices[i] = words[first_word + i];
}
