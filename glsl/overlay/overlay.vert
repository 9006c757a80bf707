// A corner of the overlay, in points of the window from its upper left.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"

layout(push_constant) uniform Push { OverlayConstants constants; };
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_coordinate;
layout(location = 2) in vec4 color;
layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 tint;

void main() {
    uv = texture_coordinate;
    tint = color;
    gl_Position = vec4(position * constants.clip_per_point - 1.0, 0.0, 1.0);
}
