// After the picture: how many pixels did not come to the end of their cuts.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_HDR_READ) uniform texture2D hdr;
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) buffer CounterBlock { Counters counters; };

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, frame.size))) return;
    if (texelFetch(hdr, ivec2(pixel), 0).a > 0.0) atomicAdd(counters.cut_given_up, 1u);
}
