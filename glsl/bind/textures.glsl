// Set 2: a material's textures, each in a slot that specialisation chose. No bindless: an array of samplers under
// constant indices, which every device has.
#ifndef BIND_TEXTURES_GLSL
#define BIND_TEXTURES_GLSL

#include "bind/frame.glsl"

layout(set = SET_material, binding = MATERIAL_SLOTS) uniform sampler2D material_textures[MATERIAL_TEXTURES];

// Texture slot of each parameter, by the order of `Parameter`.
layout(constant_id = 16) const uint SLOT_COLOR = NO_TEXTURE;
layout(constant_id = 17) const uint SLOT_SPECULAR = NO_TEXTURE;
layout(constant_id = 18) const uint SLOT_ROUGHNESS = NO_TEXTURE;
layout(constant_id = 19) const uint SLOT_ASPECT = NO_TEXTURE;
layout(constant_id = 20) const uint SLOT_SIGMA = NO_TEXTURE;
layout(constant_id = 21) const uint SLOT_ETA = NO_TEXTURE;
layout(constant_id = 22) const uint SLOT_METALLIC = NO_TEXTURE;
layout(constant_id = 23) const uint SLOT_SPECULAR_TINT = NO_TEXTURE;
layout(constant_id = 24) const uint SLOT_SHEEN = NO_TEXTURE;
layout(constant_id = 25) const uint SLOT_SHEEN_TINT = NO_TEXTURE;
layout(constant_id = 26) const uint SLOT_CLEARCOAT = NO_TEXTURE;
layout(constant_id = 27) const uint SLOT_CLEARCOAT_GLOSS = NO_TEXTURE;
layout(constant_id = 28) const uint SLOT_SUBSURFACE = NO_TEXTURE;
layout(constant_id = 29) const uint SLOT_NORMAL = NO_TEXTURE;
layout(constant_id = 30) const uint SLOT_MASK = NO_TEXTURE;

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
