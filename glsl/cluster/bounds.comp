// Step 4: each pixel's cluster id, and each cluster's bounds: the box of the samples in it, not of the froxel.
// (many lights at 16 px: 54 pairs a pixel with these bounds, 87 with the froxel's.)
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

// As in step 1: a column each, of MOST_TILES tiles at most.
layout(local_size_x_id = 46) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_SURFACE) uniform utexture2D surface_texture;
layout(set = SET_frame, binding = FRAME_CLUSTER_IDS) uniform utexture2D keys_of_pixels;
layout(set = SET_frame, binding = FRAME_CLUSTER_IDS_OUT, r32ui) writeonly uniform uimage2D cluster_ids;
layout(set = SET_frame, binding = FRAME_TILES, std430) readonly buffer TileBlock { Tile tiles[]; };
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) writeonly buffer ClusterBlock { Cluster clusters[]; };

// Whether the resolve or a cut asks which pixels a cluster has, and the resolve of which variants.
layout(constant_id = 47) const bool NOTE_PIXELS = false;
layout(constant_id = 45) const bool NOTE_VARIANTS = false;

// Relative to the distance: above what interpolating the position and reconstructing it from depth can differ by,
// below a hundredth of a cluster.
const float PAD = 1e-4;
// Numbers of a box.
const uint EXTREMES = 6u;

shared uint counts[MOST_TILES * SLICE_WORDS];  // clusters in each word of a tile's masks
// A tile's clusters: slice and quadrant, id, parent.
shared uint keys[MOST_TILES * TILE_PIXELS];
shared uint ids[MOST_TILES * TILE_PIXELS];
shared uint parents[MOST_TILES * TILE_PIXELS];
// Of each column, for as many clusters as a tile has columns.
shared float extremes[MOST_TILES * TILE_SIZE * EXTREMES * TILE_SIZE];
shared uvec3 notes[MOST_TILES * TILE_SIZE * TILE_SIZE];  // its pixels, their variants

// Of this invocation: its tile among the workgroup's, its column of it, and where it and its block lie.
uint slot;
uint column;
uint tile;
uint block;
bool outside;

// One invocation a word: its clusters, slice by slice. Returns how many the tile has, and how many another one at most.
uvec2 list_clusters() {
    uint word = column;
    uint masks[4];
    uint count = 0u;
    [[unroll]] for (uint i = 0u; i < 4u; ++i) {
        masks[i] = outside ? 0u : tiles[tile].slices[word + i * SLICE_WORDS];
        count += uint(bitCount(masks[i]));
    }
    counts[slot * SLICE_WORDS + word] = count;
    barrier();
    uint at = slot * TILE_PIXELS;
    uint all = 0u;
    uint most = 0u;
    [[unroll]] for (uint other = 0u; other < gl_WorkGroupSize.x / TILE_SIZE; ++other) {
        uint sum = 0u;
        [[unroll]] for (uint i = 0u; i < SLICE_WORDS; ++i) {
            uint clusters_of = counts[other * SLICE_WORDS + i];
            at += other == slot && i < word ? clusters_of : 0u;
            sum += clusters_of;
        }
        all = other == slot ? sum : all;
        most = max(most, sum);
    }
    uint last_band = ~0u;
    uint id = 0u;
    uint parent = 0u;
    for (uint left = masks[0] | masks[1] | masks[2] | masks[3]; left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left));
        uint slice = word << 5 | bit;
        uint band = slice >> BAND_SLICES_LOG2;
        if (band != last_band) {
            id = tiles[block].first[band] + tiles[tile].first[band];
            parent = tiles[block].slices[band];
            last_band = band;
        }
        [[unroll]] for (uint quadrant = 0u; quadrant < 4u; ++quadrant) {
            if ((masks[quadrant] >> bit & 1u) == 0u) continue;
            keys[at] = slice << 2 | quadrant;
            parents[at] = parent;
            ids[at++] = id++;
        }
    }
    barrier();
    return uvec2(all, most);
}

// Where the sums of the tile's cluster number `at` begin, in units of what they take.
uint place(uint at) { return slot * TILE_SIZE + at % TILE_SIZE; }

// What the column's samples add to the box of cluster number `at`.
void bound_column(uint at, uint wanted, uint key[TILE_SIZE], vec3 samples[TILE_SIZE]) {
    vec3 lower = vec3(1e38);
    vec3 upper = vec3(-1e38);
    [[unroll]] for (uint row = 0u; row < TILE_SIZE; ++row) {
        lower = key[row] == wanted ? min(lower, samples[row]) : lower;
        upper = key[row] == wanted ? max(upper, samples[row]) : upper;
    }
    uint first = place(at) * EXTREMES * TILE_SIZE + column;
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        extremes[first + i * TILE_SIZE] = lower[i];
        extremes[first + (3u + i) * TILE_SIZE] = upper[i];
    }
}

uint variant_bit(ivec2 pixel) {
    uint variant = texelFetch(surface_texture, pixel, 0).w >> SURFACE_MATERIAL_BITS;
    return variant == 0u ? 0u : 1u << (variant - 1u);
}

// What the column adds to the notes of cluster number `at`.
void note_column(uint at, uint wanted, uint key[TILE_SIZE], uint variants[TILE_SIZE]) {
    uvec3 note = uvec3(0u);
    [[unroll]] for (uint row = 0u; row < TILE_SIZE; ++row) {
        uint bit = 1u << ((row * TILE_SIZE + column) & 31u);
        uvec3 own = uvec3(row < 4u ? bit : 0u, row < 4u ? 0u : bit, variants[row]);
        note |= key[row] == wanted ? own : uvec3(0u);
    }
    notes[place(at) * TILE_SIZE + column] = note;
}

void write_bounds(uint at) {
    vec3 lower = vec3(1e38);
    vec3 upper = vec3(-1e38);
    uint first = place(at) * EXTREMES * TILE_SIZE;
    for (uint i = first; i < first + TILE_SIZE; ++i) {
        lower = min(lower, vec3(extremes[i], extremes[i + TILE_SIZE], extremes[i + 2u * TILE_SIZE]));
        upper = max(upper, vec3(extremes[i + 3u * TILE_SIZE], extremes[i + 4u * TILE_SIZE], extremes[i + 5u * TILE_SIZE]));
    }
    vec3 eye = abs(frame.eye);
    // No sample's view depth exceeds its distance.
    float farthest = length(max(abs(lower - frame.eye), abs(upper - frame.eye)));
    float pad = PAD * (farthest + 0.1 * max(eye.x, max(eye.y, eye.z)));
    uint id = ids[slot * TILE_PIXELS + at];
    if (id >= frame.cluster_capacity) return;
    // Nothing reaches it until step 7 counts, which it does only where there are lights for lists.
    uvec3 note = uvec3(0u);
    if (NOTE_PIXELS) {
        for (uint i = 0u; i < TILE_SIZE; ++i) note |= notes[place(at) * TILE_SIZE + i];
    }
    clusters[id] = Cluster(lower - pad, 0u, upper + pad, 0u, note.xy, tile, note.z,
                           parents[slot * TILE_PIXELS + at], 0u, 0u, 0.0, 0u,
                           0u, 0u, 0u, 0.0, 0.0, 0u, 0u);
}

void main() {
    slot = gl_LocalInvocationIndex / TILE_SIZE;
    column = gl_LocalInvocationIndex % TILE_SIZE;
    uvec2 at_tile = uvec2(gl_GlobalInvocationID.x / TILE_SIZE, gl_WorkGroupID.y);
    outside = at_tile.x >= frame.tiles.x;
    tile = at_tile.y * frame.tiles.x + at_tile.x;
    uvec2 at_block = at_tile / BLOCK_TILES;
    uint across = (frame.tiles.x + BLOCK_TILES - 1u) / BLOCK_TILES;
    block = frame.tiles.x * frame.tiles.y + at_block.y * across + at_block.x;
    uvec2 count = list_clusters();

    uint key[TILE_SIZE];
    uint id[TILE_SIZE];
    uint variants[TILE_SIZE];
    vec3 samples[TILE_SIZE];
    [[unroll]] for (uint row = 0u; row < TILE_SIZE; ++row) {
        uvec2 at = at_tile * TILE_SIZE + uvec2(column, row);
        uvec2 pixel = min(at, frame.size - 1u);
        float z = view_depth(frame, texelFetch(depth_texture, ivec2(pixel), 0).r);
        key[row] = at == pixel ? texelFetch(keys_of_pixels, ivec2(pixel), 0).r : NO_CLUSTER;
        samples[row] = world_position(frame, vec2(pixel) + 0.5, z);
        variants[row] = NOTE_VARIANTS ? variant_bit(ivec2(pixel)) : 0u;
        id[row] = NO_CLUSTER;
    }
    for (uint first = 0u; first < count.y; first += TILE_SIZE) {
        uint end = min(first + TILE_SIZE, count.x);
        for (uint at = first; at < end; ++at) {
            uint wanted = keys[slot * TILE_PIXELS + at];
            uint found = ids[slot * TILE_PIXELS + at];
            bound_column(at, wanted, key, samples);
            if (NOTE_PIXELS) note_column(at, wanted, key, variants);
            [[unroll]] for (uint row = 0u; row < TILE_SIZE; ++row) id[row] = key[row] == wanted ? found : id[row];
        }
        barrier();
        // One invocation a cluster, so no atomics.
        if (first + column < end) write_bounds(first + column);
        barrier();
    }
    [[unroll]] for (uint row = 0u; row < TILE_SIZE; ++row) {
        uvec2 pixel = at_tile * TILE_SIZE + uvec2(column, row);
        if (all(lessThan(pixel, frame.size))) imageStore(cluster_ids, ivec2(pixel), uvec4(id[row]));
    }
}
