// Accounting, outside the timed frame: pairs of pixel and light that shading evaluates, and those within range.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_PAIRS, std430) writeonly buffer PairBlock { TilePairs pairs[]; };

shared uint evaluated[TILE_PIXELS];
shared uint useful[TILE_PIXELS];

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    evaluated[lane] = 0u;
    useful[lane] = 0u;
    if (all(lessThan(pixel, frame.size))) {
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        if (depth > 0.0) {
            vec3 position = world_position(frame, vec2(pixel) + 0.5, view_depth(frame, depth));
            uint unranged = frame.light_count - frame.direct_begin;
            LightList list = list_at(ivec2(pixel));
            evaluated[lane] = list.count + unranged;
            useful[lane] = unranged;
            for (uint i = 0u; i < list.count; ++i) {
                vec4 place = light_place(list_indices(list.texel + i / 4u)[i & 3u]);
                vec3 d = place.xyz - position;
                useful[lane] += uint(dot(d, d) * place.w < 1.0);
            }
        }
    }
    barrier();
    if (lane != 0u) return;
    TilePairs sum = TilePairs(0u, 0u);
    for (uint i = 0u; i < TILE_PIXELS; ++i) {
        sum.evaluated += evaluated[i];
        sum.useful += useful[i];
    }
    pairs[gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x] = sum;
}
