// A material of one pixel in ten words, the last of which leaves its upper half free: its model and the parameters that
// this one reads.
//
// All but the principled model fit as they are, and nothing is lost. Principled has 14 numbers. Colour and the weights to
// which f is proportional are halves, ±2⁻¹² of them; the tints, which blend from 1 to a colour that may be 0, are 16-bit
// fractions, ±8e-6 at both ends. Whole floats keep what f depends on more strongly than that: the alphas (f ~ alpha⁻² at
// its peak), eta (as eta − 1), metallic (as 1 − metallic), and the gloss of the clear coat, whose alpha falls to 1e-3 of 0.1.
#ifndef LIB_BSDF_PACKED_GLSL
#define LIB_BSDF_PACKED_GLSL

#include "lib/bsdf/parameters.glsl"

const uint BSDF_WORDS = 10u;
// The model takes the lowest bits of alpha_y, 2⁻²⁰ of it.
const uint BSDF_MODEL_MASK = 7u;
const float MAX_HALF = 65504.0;

struct PackedBsdf {
    uint words[BSDF_WORDS];
};

PackedBsdf bsdf_pack(BsdfParameters p, uint model) {
    PackedBsdf b;
    b.words[0] = floatBitsToUint(p.alpha_x);
    b.words[1] = floatBitsToUint(p.alpha_y) & ~BSDF_MODEL_MASK | model;
    b.words[2] = floatBitsToUint(model == MODEL_MATTE ? p.sigma : p.eta);
    if (model == MODEL_PRINCIPLED) {
        vec3 color = min(p.color, MAX_HALF);
        b.words[3] = floatBitsToUint(p.metallic);
        b.words[4] = floatBitsToUint(p.clearcoat_gloss);
        b.words[5] = packHalf2x16(color.rg);
        b.words[6] = packHalf2x16(vec2(color.b, p.roughness));
        b.words[7] = packHalf2x16(vec2(p.sheen, p.clearcoat));
        b.words[8] = packUnorm2x16(vec2(p.specular_tint, p.sheen_tint));
        b.words[9] = packHalf2x16(vec2(p.subsurface, 0.0));
    } else {
        for (uint i = 0u; i < 3u; i++) {
            b.words[3u + i] = floatBitsToUint(p.color[i]);
            b.words[6u + i] = floatBitsToUint(p.specular[i]);
        }
        b.words[9] = 0u;
    }
    return b;
}

uint bsdf_unpack_model(PackedBsdf b) { return b.words[1] & BSDF_MODEL_MASK; }

// What the model does not read is 0.
BsdfParameters bsdf_unpack(PackedBsdf b) {
    BsdfParameters p = NO_BSDF;
    uint model = bsdf_unpack_model(b);
    float shared_word = uintBitsToFloat(b.words[2]);
    p.alpha_x = uintBitsToFloat(b.words[0]);
    p.alpha_y = uintBitsToFloat(b.words[1] & ~BSDF_MODEL_MASK);
    p.sigma = model == MODEL_MATTE ? shared_word : 0.0;
    p.eta = model == MODEL_MATTE ? 0.0 : shared_word;
    if (model != MODEL_PRINCIPLED) {
        p.color = uintBitsToFloat(uvec3(b.words[3], b.words[4], b.words[5]));
        p.specular = uintBitsToFloat(uvec3(b.words[6], b.words[7], b.words[8]));
        return p;
    }
    p.metallic = uintBitsToFloat(b.words[3]);
    p.clearcoat_gloss = uintBitsToFloat(b.words[4]);
    vec2 blue_roughness = unpackHalf2x16(b.words[6]), weights = unpackHalf2x16(b.words[7]);
    vec2 tints = unpackUnorm2x16(b.words[8]);
    p.color = vec3(unpackHalf2x16(b.words[5]), blue_roughness.x);
    p.roughness = blue_roughness.y;
    p.sheen = weights.x;
    p.clearcoat = weights.y;
    p.subsurface = unpackHalf2x16(b.words[9]).x;
    p.specular_tint = tints.x;
    p.sheen_tint = tints.y;
    return p;
}

#endif
