// Step 3: ids. Block by block and band by band, each parent that has clusters gets the next number, and its clusters the
// next ids, from a multiple of SIBLINGS on.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "cluster/scan.glsl"

layout(set = SET_frame, binding = FRAME_TILES, std430) buffer TileBlock { Tile tiles[]; };
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) writeonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) writeonly buffer CounterBlock { Counters counters; };

uint ids_of(uint count) { return (count + SIBLINGS - 1u) / SIBLINGS * SIBLINGS; }

void write_parent(uint parent, uint first, uint count) {
    uint capacity = frame.cluster_capacity;
    uint list = frame.parent_texels + parent * (PARENT_ROOM / 4u);
    if (parent < frame.parent_capacity) {
        clusters[capacity + parent] = Cluster(vec3(0.0), 0u, vec3(0.0), list, uvec2(0u), 0u, 0u, first, count, 0u, 0.0,
                                               0u, 0u, 0u, 0u, 0.0, 0.0, 0u, 0u);
    }
    for (uint id = first + count; id < min(first + ids_of(count), capacity); ++id) {
        clusters[id] = Cluster(vec3(0.0), 0u, vec3(0.0), 0u, uvec2(0u), 0u, 0u, parent, 0u, 0u, 0.0, 0u,
                               0u, 0u, 0u, 0.0, 0.0, 0u, 0u);
    }
}

// Workgroups of `each` elements: at most MAX_GROUPS a row, and rows.
uvec2 groups(uint count, uint each) {
    uint all = (count + each - 1u) / each;
    return uvec2(min(all, MAX_GROUPS), (all + MAX_GROUPS - 1u) / MAX_GROUPS);
}

void write_counters(uint ids, uint parents, uint occupied) {
    uvec2 of_clusters = groups(min(ids, frame.cluster_capacity), LINEAR_GROUP);
    uvec2 of_parents = groups(min(parents, frame.parent_capacity), 1u);
    // Of lists, should there be none.
    counters = Counters(of_clusters.x, of_clusters.y, 1u, of_parents.x, of_parents.y, 1u, 0u, 1u, 1u, parents, ids,
                        occupied, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
}

void main() {
    uvec2 blocks = (frame.tiles + BLOCK_TILES - 1u) / BLOCK_TILES;
    uint first_block = frame.tiles.x * frame.tiles.y;
    uvec2 range = chunk(blocks.x * blocks.y * BANDS);
    uint occupied = 0u;
    uint ids = 0u;
    uint parents = 0u;
    for (uint i = range.x; i < range.y; ++i) {
        uint count = tiles[first_block + i / BANDS].slices[i % BANDS];
        occupied += count;
        ids += ids_of(count);
        parents += uint(count > 0u);
    }
    uint all_ids, all_parents, all_occupied;
    uint first = exclusive_sum(ids, all_ids);
    barrier();
    uint parent = exclusive_sum(parents, all_parents);
    barrier();
    exclusive_sum(occupied, all_occupied);
    for (uint i = range.x; i < range.y; ++i) {
        uint block = first_block + i / BANDS;
        uint count = tiles[block].slices[i % BANDS];
        if (count == 0u) continue;
        tiles[block].first[i % BANDS] = first;
        tiles[block].slices[i % BANDS] = parent;
        write_parent(parent, first, count);
        first += ids_of(count);
        ++parent;
    }
    if (gl_LocalInvocationIndex == 0u) write_counters(all_ids, all_parents, all_occupied);
}
