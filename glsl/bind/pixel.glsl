// The surface of a pixel, from what the prepass left of it, for bind/surface.glsl: a compute shader turns to one pixel after
// the other with `at_pixel`. Of materials without textures and without a tangent's direction only.
#ifndef BIND_PIXEL_GLSL
#define BIND_PIXEL_GLSL

#include "bind/frame.glsl"
#include "bind/slots.glsl"
#include "lib/rows.glsl"

layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_frame, binding = FRAME_SURFACE) uniform utexture2D surface_texture;
layout(set = SET_resolve, binding = RESOLVE_MATERIALS) uniform texture2D material_records;

vec3 in_window;
vec3 in_normal;
uint in_material;
const vec4 in_tangent = vec4(0.0);

// Which of the variants that compute shades a surface has, counted from 1; 0: none of them.
uint surface_variant(uvec4 surface) { return surface.w >> SURFACE_MATERIAL_BITS; }

// Later questions are about this pixel; answers its variant.
uint at_pixel(ivec2 pixel) {
    uvec4 surface = texelFetch(surface_texture, pixel, 0);
    in_window = vec3(vec2(pixel) + 0.5, texelFetch(depth_texture, pixel, 0).r);
    in_normal = uintBitsToFloat(surface.xyz);
    in_material = surface.w & ((1u << SURFACE_MATERIAL_BITS) - 1u);
    return surface_variant(surface);
}

vec3 window_position() { return in_window; }

// A texture, not a uniform block: neighbouring pixels may have different materials.
vec3 parameter(uint row, uint slot) {
    return texelFetch(material_records, in_records(in_material, row), 0).xyz;
}

// No variant that comes here has a normal map.
vec3 normal_texel() { return vec3(0.5, 0.5, 1.0); }

#endif
