// Sampling of any model: a mixture of wide lobes and microfacet lobes, as `reference::bsdf::sampling` has it. Its density
// need not match f, only cover it.
//
// Asks of the including shader what lib/bsdf.glsl asks.
#ifndef LIB_BSDF_SAMPLE_GLSL
#define LIB_BSDF_SAMPLE_GLSL

#include "lib/bsdf.glsl"
#include "lib/bsdf/lobe_sampling.glsl"
#include "lib/bsdf/skimming.glsl"

// Shares of the lobes, and their shapes.
struct BsdfSampling {
    vec3 wo;
    float cosine;
    float even;     // of the hemisphere
    float specular; // Trowbridge–Reitz, by visible normals
    float skimming;
    float coat;     // GTR1
    Ggx ggx;
    Gtr1 gtr1;
};

// Least share of a lobe that exists, so that a wrong guess of its albedo costs noise and never a spike.
const float LEAST_SHARE = 0.1;
// Below 1, to which quotients of shares may round.
const float LARGEST_UNIT = 1.0 - 1.0 / 16777216.0;

// Rough albedos, from which the shares follow. A `diffuse` of 0 says that there is nothing diffuse, and a `coat` of 0 that
// there is none; a `specular` of 0 is only a guess.
struct BsdfAlbedos {
    float diffuse;
    float even; // share of `diffuse` that is even: what does not vanish at grazing angles would weigh up to 1/cosθo
    float specular;
    float skimming; // share of `specular` that skims, for the same reason
    float coat;
};

BsdfAlbedos matte_albedos(BsdfParameters p, float sin_o) {
    OrenNayar shape = oren_nayar(p);
    float even = 0.5 * shape.b * sin_o;
    return BsdfAlbedos(1.0, even / (shape.a + even), 0.0, 0.0, 0.0);
}

BsdfAlbedos plastic_albedos(BsdfParameters p, float cos_o) {
    float fresnel = fresnel_dielectric((p.eta - 1.0) * (p.eta + 1.0), sqr(cos_o));
    return BsdfAlbedos(greatest(p.color), 0.0, greatest(p.specular) * fresnel, 0.0, 0.0);
}

BsdfAlbedos substrate_albedos(BsdfParameters p, vec3 wo, float cos_o) {
    float weight = pow5(1.0 - cos_o);
    float base = greatest(p.color * (1.0 - p.specular)) * schlick_complement(0.5 * cos_o);
    // Visible normals weigh (cosθo + L)/(2 cosθo) at most, L about alpha at grazing angles. The rest is L − cosθo without
    // the subtraction, which leaves no digit of it where alpha is small.
    Ggx ggx = ggx_setup(p.alpha_x, p.alpha_y, wo);
    float rest = dot(ggx.alpha2, sqr(wo).xy) / (ggx.stretch_o + cos_o);
    float skimming = 0.3 * rest / max(rest + 2.0 * cos_o, TINY);
    return BsdfAlbedos(base, 0.0, lerp(greatest(p.specular), 1.0, weight), skimming, 0.0);
}

BsdfAlbedos principled_albedos(BsdfParameters p, float cos_o) {
    float weight = pow5(1.0 - cos_o);
    float metallic = LOBE_METALLIC ? p.metallic : 0.0;
    float sheen = LOBE_SHEEN ? p.sheen : 0.0;
    float even = LOBE_SUBSURFACE ? 0.5 * p.subsurface * (1.0 - cos_o) : 0.0;
    float base = (1.0 - metallic) * (greatest(p.color) + 0.2 * sheen);
    float specular = lerp(greatest(principled_f0(p)), 1.0, weight);
    float coat = LOBE_CLEARCOAT ? 0.25 * p.clearcoat * lerp(CLEARCOAT_F0, 1.0, weight) : 0.0;
    return BsdfAlbedos(base, even, specular, 0.0, coat);
}

BsdfAlbedos bsdf_albedos(BsdfParameters p, vec3 wo) {
    float cos_o = clamp(wo.z, 0.0, 1.0);
    if (IS_MODEL(MODEL_MATTE)) return matte_albedos(p, length(wo.xy));
    if (IS_MODEL(MODEL_PLASTIC)) return plastic_albedos(p, cos_o);
    if (IS_MODEL(MODEL_SUBSTRATE)) return substrate_albedos(p, wo, cos_o);
    if (IS_MODEL(MODEL_PRINCIPLED)) return principled_albedos(p, cos_o);
    // Visible normals leave of metal its F and the shadowing, which never exceed 1.
    return BsdfAlbedos(0.0, 0.0, 1.0, 0.0, 0.0);
}

BsdfSampling bsdf_sampling(BsdfParameters p, vec3 wo) {
    BsdfAlbedos a = bsdf_albedos(p, wo);
    float diffuse = 0.0;
    if (a.diffuse > 0.0) diffuse = clamp(a.diffuse / (a.diffuse + a.specular), LEAST_SHARE, 1.0 - LEAST_SHARE);
    if (IS_MODEL(MODEL_MATTE)) diffuse = 1.0;
    float coat = a.coat > 0.0 ? max(a.coat / (1.0 + a.coat), LEAST_SHARE) : 0.0;

    BsdfSampling s;
    s.wo = wo;
    s.cosine = (1.0 - coat) * diffuse * (1.0 - a.even);
    s.even = (1.0 - coat) * diffuse * a.even;
    s.specular = (1.0 - coat) * (1.0 - diffuse) * (1.0 - a.skimming);
    s.skimming = (1.0 - coat) * (1.0 - diffuse) * a.skimming;
    s.coat = coat;
    s.ggx = ggx_setup(p.alpha_x, p.alpha_y, wo);
    s.gtr1 = gtr1_setup(lerp(0.1, 0.001, p.clearcoat_gloss));
    return s;
}

// A unit direction to the light, possibly below the surface, for two numbers in [0, 1). The first also chooses the lobe and
// is stretched back; shares may round to a sum below it, so that the last lobe that exists takes what is left.
vec3 bsdf_sample(BsdfSampling s, vec2 xi) {
    float x = xi.x;
    if (x < s.cosine) return normalize(cosine_direction(vec2(min(x / s.cosine, LARGEST_UNIT), xi.y)));
    x -= s.cosine;
    if (x < s.even || s.specular == 0.0 || !bsdf_has(LOBE_SPECULAR)) {
        return normalize(even_direction(vec2(min(x / s.even, LARGEST_UNIT), xi.y)));
    }
    x -= s.even;
    if (x < s.skimming) {
        vec2 stretched = vec2(min(x / s.skimming, LARGEST_UNIT), xi.y);
        return normalize(skimming_direction(skimming_setup(s.ggx, s.wo), stretched));
    }
    x -= s.skimming;
    vec3 h;
    if (x < s.specular || s.coat == 0.0) {
        h = ggx_visible_normal(s.ggx, s.wo, vec2(min(x / s.specular, LARGEST_UNIT), xi.y));
    } else {
        h = gtr1_normal(s.gtr1, vec2(min((x - s.specular) / s.coat, LARGEST_UNIT), xi.y));
    }
    return normalize(2.0 * dot(s.wo, h) * h - s.wo);
}

// Density of bsdf_sample at wi, sr⁻¹; 0 unless both directions lie above the surface.
float bsdf_pdf(BsdfSampling s, vec3 wi) {
    if (s.wo.z <= 0.0 || wi.z <= 0.0) return 0.0;
    HalfVector h = half_vector(s.wo, wi);
    float wide = (s.cosine * wi.z + 0.5 * s.even) * INV_PI;
    float narrow = 0.0;
    if (bsdf_has(LOBE_SPECULAR)) narrow = s.specular * ggx_pdf(s.ggx, h, s.wo.z);
    if (bsdf_has(LOBE_COAT)) narrow += s.coat * gtr1_pdf(s.gtr1, h);
    // Only the substrate skims.
    if (s.skimming > 0.0) narrow += s.skimming * skimming_pdf(skimming_setup(s.ggx, s.wo), wi);
    return wide + narrow;
}

#endif
