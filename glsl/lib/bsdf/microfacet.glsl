// Trowbridge–Reitz (GGX) microfacets: Walter et al. 2007, anisotropic as in Burley 2012, G as in Heitz 2014.
//
// The half vector is never normalised. With H = wi + wo: wi·h = |H|/2, and every use of h in D is a ratio of squares of
// H. Sums of float32 directions are exact to an ulp, so D keeps its relative precision at alpha = 1e-3, where the usual
// cos²(alpha² − 1) + 1 is 3 % off.
#ifndef LIB_BSDF_MICROFACET_GLSL
#define LIB_BSDF_MICROFACET_GLSL

#include "lib/math.glsl"

const float MIN_ALPHA = 1e-3;

struct HalfVector {
    vec3 squared;  // H∘H
    float length2; // |H|² = 4 (wi·h)²
};

HalfVector half_vector(vec3 wo, vec3 wi) {
    HalfVector h;
    h.squared = sqr(wi + wo);
    h.length2 = h.squared.x + h.squared.y + h.squared.z;
    return h;
}

struct Ggx {
    vec2 alpha2;     // alpha_x², alpha_y²
    vec2 inv_alpha2;
    float stretch_o; // L(wo)
    float norm;      // 1 / (π alpha_x alpha_y)
};

// L(w) = √((αx wx)² + (αy wy)² + wz²), in which Smith's Λ(w) is (L/wz − 1)/2.
float ggx_stretch(Ggx ggx, vec3 w) {
    if (ANISOTROPIC) {
        return sqrt(ggx.alpha2.x * sqr(w.x) + ggx.alpha2.y * sqr(w.y) + sqr(w.z));
    }
    return sqrt(ggx.alpha2.x + (1.0 - ggx.alpha2.x) * sqr(w.z));
}

Ggx ggx_setup(float alpha_x, float alpha_y, vec3 wo) {
    vec2 alpha = max(vec2(alpha_x, ANISOTROPIC ? alpha_y : alpha_x), MIN_ALPHA);
    Ggx ggx;
    ggx.alpha2 = alpha * alpha;
    ggx.inv_alpha2 = 1.0 / ggx.alpha2;
    ggx.norm = INV_PI / (alpha.x * alpha.y);
    ggx.stretch_o = ggx_stretch(ggx, wo);
    return ggx;
}

// D(h) / norm = (|H|² / ((Hx/αx)² + (Hy/αy)² + Hz²))², in [alpha⁴, 1].
float ggx_distribution(Ggx ggx, HalfVector h) {
    float denominator;
    if (ANISOTROPIC) {
        denominator = h.squared.x * ggx.inv_alpha2.x + h.squared.y * ggx.inv_alpha2.y + h.squared.z;
    } else {
        denominator = (h.squared.x + h.squared.y) * ggx.inv_alpha2.x + h.squared.z;
    }
    return sqr(h.length2 / max(denominator, TINY));
}

// 2 cosθi V, where V = G/(4 cosθi cosθo) is Smith's height-correlated visibility, ½ / (cosθi L(wo) + cosθo L(wi)).
float ggx_visibility_correlated(Ggx ggx, float cos_o, float cos_i, vec3 wi) {
    return cos_i / max(cos_i * ggx.stretch_o + cos_o * ggx_stretch(ggx, wi), TINY);
}

// cosθi V1(wi) of Smith's separable visibility, V = V1(wi) V1(wo) with V1(w) = 1 / (cosθ + L(w)). L(0) = 0, and wi = 0
// is what a light on the surface has for a direction.
float ggx_visibility_separable(Ggx ggx, float cos_i, vec3 wi) {
    return cos_i / max(cos_i + ggx_stretch(ggx, wi), TINY);
}

#endif
