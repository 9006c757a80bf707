// Exposure, tone curve, encoding.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "present/encode.glsl"

layout(set = SET_frame, binding = FRAME_HDR, input_attachment_index = 0) uniform subpassInput hdr;
layout(push_constant, std430) uniform PushBlock { DrawConstants draw; };
layout(location = 0) out vec4 color;

void main() { color = encoded(subpassLoad(hdr).rgb * draw.scale); }
