// As present.frag, with gathered light: the sum over all subsets, of virtual lights and of the scene's own.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "present/encode.glsl"

layout(set = SET_frame, binding = FRAME_HDR, input_attachment_index = 0) uniform subpassInput hdr;
layout(set = SET_frame, binding = FRAME_GATHERED) uniform texture2DArray gathered_light;
layout(constant_id = 55) const bool GATHER_POINTS = true;
layout(constant_id = 56) const bool GATHER_INDIRECT = true;
layout(push_constant, std430) uniform PushBlock { DrawConstants draw; };
layout(location = 0) out vec4 color;

void main() {
    vec3 gathered = vec3(0.0);
    uint kinds = uint(GATHER_POINTS) + uint(GATHER_INDIRECT);
    for (int layer = 0; layer < int(kinds * GATHER_SUBSETS); ++layer) {
        gathered += texelFetch(gathered_light, ivec3(gl_FragCoord.xy, layer), 0).rgb;
    }
    // The share of a pixel that paths take off what was gathered may outweigh it while frames are few.
    color = encoded(max(subpassLoad(hdr).rgb * draw.scale + gathered * draw.gathered, 0.0));
}
