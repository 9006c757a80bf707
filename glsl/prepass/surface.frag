// What compute shading needs of a pixel's surface, with the alpha test of masked materials: the normal just as fragments
// would have it, and the draw's word.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/textures.glsl"

layout(push_constant, std430) uniform PushBlock { DrawConstants draw; };
layout(location = 1) in vec3 normal;
layout(location = 3) in vec2 uv;
layout(location = 0) out uvec4 surface;

void main() {
    if (SLOT_MASK != NO_TEXTURE && sample_slot(SLOT_MASK, uv).r < 0.5) discard;
    surface = uvec4(floatBitsToUint(normal), draw.surface);
}
