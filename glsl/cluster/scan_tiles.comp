// Step 2: ids. Tile by tile, each occupied slice gets the next id.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_TILES, std430) buffer TileBlock { Tile tiles[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) writeonly buffer CounterBlock { Counters counters; };

void main() {
    uvec2 range = chunk(frame.tiles.x * frame.tiles.y);
    uint sum = 0u;
    for (uint tile = range.x; tile < range.y; ++tile) sum += tiles[tile].count;
    uint total;
    uint first = exclusive_sum(sum, total);
    for (uint tile = range.x; tile < range.y; ++tile) {
        tiles[tile].first = first;
        first += tiles[tile].count;
    }
    if (gl_LocalInvocationIndex == 0u) {
        uint groups = (min(total, frame.cluster_capacity) + LINEAR_GROUP - 1u) / LINEAR_GROUP;
        counters.groups_x = min(groups, MAX_GROUPS);
        counters.groups_y = (groups + MAX_GROUPS - 1u) / MAX_GROUPS;
        counters.groups_z = 1u;
        counters.clusters = total;
        // Of lists, should there be none.
        counters.list_texels = 0u;
        counters.entries = 0u;
        counters.longest = 0u;
        counters.overflowed = 0u;
        counters.dropped = 0u;
        counters.cut_entries = 0u;
        counters.cut_longest = 0u;
    }
}
