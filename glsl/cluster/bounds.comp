// Step 3: each pixel's cluster id, and each cluster's bounds: the box of the samples in it, not of the froxel.
// (many lights at 16 px: 54 pairs a pixel with these bounds, 87 with the froxel's.)
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_CLUSTER_IDS_OUT, r32ui) writeonly uniform uimage2D cluster_ids;
layout(set = SET_frame, binding = FRAME_TILES, std430) readonly buffer TileBlock { Tile tiles[]; };
layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) writeonly buffer ClusterBlock { Cluster clusters[]; };

// Relative to the view depth: above what interpolating the position and reconstructing it from depth can differ by,
// below a hundredth of a cluster.
const float PAD = 1e-4;

shared uint slices[SLICE_WORDS];
shared uint ranks[TILE_PIXELS];
shared vec4 samples[TILE_PIXELS];  // world position, view depth

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint tile = gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x;
    if (lane < SLICE_WORDS) slices[lane] = tiles[tile].slices[lane];
    barrier();

    uvec2 pixel = gl_GlobalInvocationID.xy;
    uint rank = NO_CLUSTER;
    if (all(lessThan(pixel, frame.size))) {
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        uint id = NO_CLUSTER;
        if (depth > 0.0) {
            float z = view_depth(frame, depth);
            uint slice = slice_of(frame, z);
            uint word = slice >> 5;
            rank = uint(bitCount(slices[word] & ((1u << (slice & 31u)) - 1u)));
            for (uint lower = 0u; lower < word; ++lower) rank += uint(bitCount(slices[lower]));
            // Step 1 took the same logarithm in another pipeline, where it may have rounded to another slice: the sample
            // then joins a neighbour, whose bounds follow it, but never the next tile's first cluster.
            rank = min(rank, tiles[tile].count - 1u);
            samples[lane] = vec4(world_position(frame, vec2(pixel) + 0.5, z), z);
            id = tiles[tile].first + rank;
        }
        imageStore(cluster_ids, ivec2(pixel), uvec4(id));
    }
    ranks[lane] = rank;
    barrier();

    // One invocation a cluster: no atomics, and in most tiles all of them share one vector.
    uint id = tiles[tile].first + lane;
    if (lane >= tiles[tile].count || id >= frame.cluster_capacity) return;
    vec3 lower = vec3(1e38);
    vec3 upper = vec3(-1e38);
    float farthest = 0.0;
    for (uint i = 0u; i < TILE_PIXELS; ++i) {
        if (ranks[i] != lane) continue;
        lower = min(lower, samples[i].xyz);
        upper = max(upper, samples[i].xyz);
        farthest = max(farthest, samples[i].w);
    }
    vec3 eye = abs(frame.eye);
    float pad = PAD * (farthest + 0.1 * max(eye.x, max(eye.y, eye.z)));
    clusters[id].lower = lower - pad;
    clusters[id].upper = upper + pad;
}
