// Step 2: the clusters of each band in a block of tiles. One workgroup a block, one invocation a band.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"

layout(local_size_x = BANDS) in;
layout(set = SET_frame, binding = FRAME_TILES, std430) buffer TileBlock { Tile tiles[]; };

void main() {
    uint band = gl_LocalInvocationIndex;
    uint slice = band << BAND_SLICES_LOG2;
    uint mask = ((1u << (1u << BAND_SLICES_LOG2)) - 1u) << (slice & 31u);
    uint sum = 0u;
    for (uint i = 0u; i < BLOCK_TILES * BLOCK_TILES; ++i) {
        uvec2 at = gl_WorkGroupID.xy * BLOCK_TILES + uvec2(i % BLOCK_TILES, i / BLOCK_TILES);
        if (any(greaterThanEqual(at, frame.tiles))) continue;
        uint tile = at.y * frame.tiles.x + at.x;
        tiles[tile].first[band] = sum;
        for (uint word = slice >> 5; word < TILE_WORDS; word += SLICE_WORDS) {
            sum += uint(bitCount(tiles[tile].slices[word] & mask));
        }
    }
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    tiles[frame.tiles.x * frame.tiles.y + block].slices[band] = sum;
}
