// Set 2: a material's textures, each in a slot that specialisation chose. No bindless: an array of samplers under
// constant indices, which every device has.
#ifndef BIND_TEXTURES_GLSL
#define BIND_TEXTURES_GLSL

#include "bind/frame.glsl"
#include "bind/slots.glsl"

layout(set = SET_material, binding = MATERIAL_SLOTS) uniform sampler2D material_textures[MATERIAL_TEXTURES];

// Compares with constants, so that each index is one and all but one sample is compiled away.
// Texture coordinates begin at the image's lower left, texels at its top.
vec4 sample_slot(uint slot, vec2 uv) {
    uv.y = 1.0 - uv.y;
    if (slot == 0u) return texture(material_textures[0], uv, frame.texture_bias);
    if (slot == 1u) return texture(material_textures[1], uv, frame.texture_bias);
    if (slot == 2u) return texture(material_textures[2], uv, frame.texture_bias);
    if (slot == 3u) return texture(material_textures[3], uv, frame.texture_bias);
    if (slot == 4u) return texture(material_textures[4], uv, frame.texture_bias);
    if (slot == 5u) return texture(material_textures[5], uv, frame.texture_bias);
    if (slot == 6u) return texture(material_textures[6], uv, frame.texture_bias);
    return texture(material_textures[7], uv, frame.texture_bias);
}

#endif
