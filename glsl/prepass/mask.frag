// Alpha test; surfaces without a mask have no fragment shader in the prepass.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/textures.glsl"

layout(location = 3) in vec2 uv;

void main() {
    if (sample_slot(SLOT_MASK, uv).r < 0.5) discard;
}
