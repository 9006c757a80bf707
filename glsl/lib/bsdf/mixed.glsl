// Models known at run time only: for a compute shader that meets the surfaces of a whole scene in one dispatch. What none of
// them has is not compiled: of a scene where all is Lambertian, gathering takes 1.2 times as long with every model.
#ifndef LIB_BSDF_MIXED_GLSL
#define LIB_BSDF_MIXED_GLSL

layout(constant_id = 1) const bool ANISOTROPIC = true;
layout(constant_id = 3) const bool ROUGH_MATTE = true;
layout(constant_id = 4) const bool LOBE_SHEEN = true;
layout(constant_id = 5) const bool LOBE_CLEARCOAT = true;
layout(constant_id = 6) const bool LOBE_SUBSURFACE = true;
layout(constant_id = 7) const bool LOBE_METALLIC = true;
// A bit for each model that may be met.
layout(constant_id = 58) const uint BSDF_MODELS = 31u;

// Of the surface that later questions are about.
uint surface_model;

bool is_model(uint model) {
    uint bit = 1u << model;
    if (BSDF_MODELS == bit) return true;
    return (BSDF_MODELS & bit) != 0u && surface_model == model;
}

#define IS_MODEL(model) is_model(model)

#endif
