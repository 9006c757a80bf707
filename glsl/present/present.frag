// Exposure, tone curve, encoding; no dithering.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "lib/tonemap.glsl"

layout(set = SET_frame, binding = FRAME_HDR, input_attachment_index = 0) uniform subpassInput hdr;
layout(push_constant, std430) uniform PushBlock { DrawConstants draw; };
layout(constant_id = 10) const uint TONEMAP = 0u;
layout(constant_id = 61) const uint ENCODING = 0u;
layout(location = 0) out vec4 color;

void main() {
    vec3 c = subpassLoad(hdr).rgb * draw.scale;
    if (TONEMAP == 1u) c = aces(c);
    if (TONEMAP == 2u) c = agx(c);
    if (ENCODING == ENCODING_SRGB) c = srgb_encode(c);
    if (ENCODING == ENCODING_SCRGB) c = scrgb_encode(c);
    if (ENCODING == ENCODING_HDR10) c = hdr10_encode(c);
    color = vec4(c, 1.0);
}
