// Accounting, outside the timed frame: pairs of pixel and light that shading evaluates, and those within range or before
// the light.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/within.glsl"
#include "bind/area_lights.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_pairs, binding = PAIRS_TILES, std430) writeonly buffer PairBlock { TilePairs pairs[]; };

shared TilePairs sums[TILE_PIXELS];

// Whether any of a light can be seen from a place.
bool before(AreaLight light, vec3 position) {
    return light.kind == AREA_LINE || light.two_sided || dot(light.normal, position - light.center) > 0.0;
}

// Each area light that the pixel evaluates, a bit of a word after the other.
uint area_useful(ivec2 pixel, vec3 position) {
    uint useful = 0u;
    for (uint first = 0u; first < frame.area_lights; first += 32u) {
        uint bits = frame.area_lights - first < 32u ? (1u << (frame.area_lights - first)) - 1u : ~0u;
        if (frame.area_texels != 0u) bits = area_mask(cluster_at(pixel), first >> 5);
        for (; bits != 0u; bits &= bits - 1u) {
            useful += uint(before(area_light(first + uint(findLSB(bits))), position));
        }
    }
    return useful;
}

TilePairs pairs_of(ivec2 pixel, vec3 position) {
    uint unranged = unranged_count(pixel);
    LightList list = list_at(pixel);
    uint area = area_count(pixel);
    // Nodes count as lights, and all as useful: what they stand for reaches the cluster.
    uint useful = lights_within(list, position) + list.nodes + unranged + area_useful(pixel, position);
    return TilePairs(list.count + list.nodes + unranged + area, useful, area, frame.area_lights);
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    sums[lane] = TilePairs(0u, 0u, 0u, 0u);
    if (all(lessThan(pixel, frame.size))) {
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        if (depth > 0.0) {
            vec3 position = world_position(frame, vec2(pixel) + 0.5, view_depth(frame, depth));
            sums[lane] = pairs_of(ivec2(pixel), position);
        }
    }
    barrier();
    if (lane != 0u) return;
    TilePairs sum = TilePairs(0u, 0u, 0u, 0u);
    for (uint i = 0u; i < TILE_PIXELS; ++i) {
        sum.evaluated += sums[i].evaluated;
        sum.useful += sums[i].useful;
        sum.area += sums[i].area;
        sum.area_all += sums[i].area_all;
    }
    pairs[gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x] = sum;
}
