// The overlay: colours are sRGB-encoded like the picture below, and blended as they are, as egui's are meant to be.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"

layout(set = SET_overlay, binding = OVERLAY_TEXTURE) uniform sampler2D image;
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 tint;
layout(location = 0) out vec4 color;

void main() {
    color = tint * texture(image, uv);
}
