// The five BSDFs behind one interface: set up once per pixel, evaluate for many lights.
//
// Directions are unit vectors in the local frame: z the normal, x the tangent; wo to the viewer, wi to the light. f is
// the BRDF in sr⁻¹, zero unless both lie above the surface. Each model's file names its paper.
//
// The including shader defines these before this line, as specialisation constants or macros:
//   int MODEL             MODEL_MATTE … MODEL_PRINCIPLED, or IS_MODEL(m) where it is not a constant
//   bool ANISOTROPIC      false: alpha_x is the alpha of both axes
//   bool ROUGH_MATTE      false: sigma is 0
//   bool LOBE_SUBSURFACE, LOBE_SHEEN, LOBE_CLEARCOAT, LOBE_METALLIC   false: that weight of principled is 0
// Constants, because Mesa 22.3.6 runs what lies behind an untaken branch too: a lobe that nobody has must not exist.
// A compute shader that meets several models in one dispatch takes them from lib/bsdf/mixed.glsl.
// SwiftShader keeps even what specialisation constants rule out (27 ns per evaluation of any model, 3 with macros).
#ifndef LIB_BSDF_GLSL
#define LIB_BSDF_GLSL

#include "lib/bsdf/parameters.glsl"
#include "lib/bsdf/matte.glsl"
#include "lib/bsdf/plastic.glsl"
#include "lib/bsdf/metal.glsl"
#include "lib/bsdf/substrate.glsl"
#include "lib/bsdf/principled.glsl"

// Only the members of models that there are are ever set or read; the others leave no trace in the compiled shader.
struct Bsdf {
    Matte matte;
    Plastic plastic;
    Metal metal;
    Substrate substrate;
    Principled principled;
};

Bsdf bsdf_setup(BsdfParameters p, vec3 wo) {
    Bsdf b;
    if (IS_MODEL(MODEL_MATTE)) b.matte = matte_setup(p, wo);
    if (IS_MODEL(MODEL_PLASTIC)) b.plastic = plastic_setup(p, wo);
    if (IS_MODEL(MODEL_METAL)) b.metal = metal_setup(p, wo);
    if (IS_MODEL(MODEL_SUBSTRATE)) b.substrate = substrate_setup(p, wo);
    if (IS_MODEL(MODEL_PRINCIPLED)) b.principled = principled_setup(p, wo);
    return b;
}

// f(wo, wi) cosθi.
vec3 bsdf_eval_cos(Bsdf b, vec3 wi) {
    if (IS_MODEL(MODEL_MATTE)) return matte_eval_cos(b.matte, wi);
    if (IS_MODEL(MODEL_PLASTIC)) return plastic_eval_cos(b.plastic, wi);
    if (IS_MODEL(MODEL_METAL)) return metal_eval_cos(b.metal, wi);
    if (IS_MODEL(MODEL_SUBSTRATE)) return substrate_eval_cos(b.substrate, wi);
    if (IS_MODEL(MODEL_PRINCIPLED)) return principled_eval_cos(b.principled, wi);
    return vec3(0.0);
}

// The lobes of one BSDF, each with a shape of its own: area lights are integrated lobe by lobe.
const uint LOBE_DIFFUSE = 0u;   // all that is wide: Lambert, Oren–Nayar, retro-reflection, subsurface, sheen
const uint LOBE_SPECULAR = 1u;  // Trowbridge–Reitz
const uint LOBE_COAT = 2u;      // GTR1
const uint LOBES = 3u;

// Whether the model has that lobe; known when the pipeline is compiled, if MODEL is.
bool bsdf_has(uint lobe) {
    if (lobe == LOBE_DIFFUSE) return !IS_MODEL(MODEL_METAL);
    if (lobe == LOBE_SPECULAR) return !IS_MODEL(MODEL_MATTE);
    return IS_MODEL(MODEL_PRINCIPLED) && LOBE_CLEARCOAT;
}

// One lobe's share of f(wo, wi) cosθi; `lobe` is a constant wherever this is called.
vec3 bsdf_eval_lobe_cos(Bsdf b, vec3 wi, uint lobe) {
    if (IS_MODEL(MODEL_PLASTIC)) {
        return lobe == LOBE_DIFFUSE ? plastic_diffuse_cos(b.plastic, wi) : plastic_specular_cos(b.plastic, wi);
    }
    if (IS_MODEL(MODEL_SUBSTRATE)) {
        return lobe == LOBE_DIFFUSE ? substrate_diffuse_cos(b.substrate, wi) : substrate_specular_cos(b.substrate, wi);
    }
    if (IS_MODEL(MODEL_PRINCIPLED)) {
        PrincipledPair p = principled_pair(b.principled, wi);
        if (lobe == LOBE_DIFFUSE) return principled_diffuse_cos(b.principled, p);
        if (lobe == LOBE_SPECULAR) return principled_specular_cos(b.principled, p, wi);
        return vec3(principled_coat_cos(b.principled, p));
    }
    return bsdf_eval_cos(b, wi);
}

// f(wo, wi), for tests and tables: every model's quotients contain cosθi, so dividing it out costs one ulp.
vec3 bsdf_eval(Bsdf b, vec3 wi) {
    return bsdf_eval_cos(b, wi) / max(wi.z, MIN_COSINE);
}

#endif
