// Step 1: the occupied slices of each tile. One workgroup a tile, one invocation a column: on lavapipe that is one vector,
// and a barrier costs nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

layout(local_size_x = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_TILES, std430) writeonly buffer TileBlock { Tile tiles[]; };

shared uint slices[SLICE_WORDS];

void main() {
    uint lane = gl_LocalInvocationIndex;
    if (lane < SLICE_WORDS) slices[lane] = 0u;
    barrier();

    for (uint row = 0u; row < TILE_SIZE; ++row) {
        uvec2 pixel = gl_WorkGroupID.xy * TILE_SIZE + uvec2(lane, row);
        if (any(greaterThanEqual(pixel, frame.size))) continue;
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        if (depth > 0.0) {
            uint slice = slice_of(frame, view_depth(frame, depth));
            atomicOr(slices[slice >> 5], 1u << (slice & 31u));
        }
    }
    barrier();

    uint tile = gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x;
    if (lane < SLICE_WORDS) tiles[tile].slices[lane] = slices[lane];
    if (lane == 0u) {
        uint count = 0u;
        for (uint word = 0u; word < SLICE_WORDS; ++word) count += uint(bitCount(slices[word]));
        tiles[tile].count = count;
    }
}
