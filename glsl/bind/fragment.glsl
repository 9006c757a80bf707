// The surface under a fragment: interpolated attributes and the material's record, for bind/surface.glsl.
#ifndef BIND_FRAGMENT_GLSL
#define BIND_FRAGMENT_GLSL

#include "bind/textures.glsl"

// A uniform block of its own: lavapipe reads storage buffers lane by lane.
layout(set = SET_material, binding = MATERIAL_RECORD, std140) uniform MaterialBlock { MaterialRecord material; };
layout(push_constant, std430) uniform PushBlock { DrawConstants draw; };

layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv;

// Pixel coordinates and depth.
vec3 window_position() { return gl_FragCoord.xyz; }

vec3 parameter(uint row, uint slot) {
    if (slot != NO_TEXTURE) return sample_slot(slot, in_uv).rgb;
    return material.rows[row].xyz;
}

vec3 normal_texel() { return sample_slot(SLOT_NORMAL, in_uv).xyz; }

#endif
