// The Lambertian share of a BSDF, as a reflectance: what a virtual light at the surface stands for.
#ifndef LIB_BSDF_LAMBERT_GLSL
#define LIB_BSDF_LAMBERT_GLSL

#include "lib/bsdf/matte.glsl"
#include "lib/bsdf/parameters.glsl"

// Asks of the including shader what lib/bsdf.glsl asks.
vec3 bsdf_lambert(BsdfParameters p) {
    if (IS_MODEL(MODEL_MATTE)) return p.color * oren_nayar(p).a;
    if (IS_MODEL(MODEL_PLASTIC)) return p.color;
    if (IS_MODEL(MODEL_SUBSTRATE)) return p.color * (1.0 - p.specular);
    if (IS_MODEL(MODEL_PRINCIPLED)) return p.color * (LOBE_METALLIC ? 1.0 - p.metallic : 1.0);
    return vec3(0.0);
}

#endif
