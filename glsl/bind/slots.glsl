// Which parameters of a material have textures.
#ifndef BIND_SLOTS_GLSL
#define BIND_SLOTS_GLSL

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

#endif
