// Oren and Nayar 1994, qualitative model, as pbrt writes it: color/π · (A + B max(s, 0)/t).
#ifndef LIB_BSDF_MATTE_GLSL
#define LIB_BSDF_MATTE_GLSL

#include "lib/math.glsl"
#include "lib/bsdf/parameters.glsl"

struct Matte {
    vec3 flat_part;  // color A/π
    vec3 rough_part; // color B/π
    vec3 wo;
    float inv_cos_o;
};

// A, of the Lambertian share, and B.
struct OrenNayar {
    float a;
    float b;
};

OrenNayar oren_nayar(BsdfParameters p) {
    if (!ROUGH_MATTE) return OrenNayar(1.0, 0.0);
    float sigma2 = sqr(p.sigma * RADIANS_PER_DEGREE);
    return OrenNayar(1.0 - 0.5 * sigma2 / (sigma2 + 0.33), 0.45 * sigma2 / (sigma2 + 0.09));
}

Matte matte_setup(BsdfParameters p, vec3 wo) {
    OrenNayar shape = oren_nayar(p);
    vec3 lambert = p.color * (INV_PI * faces_viewer(wo));
    return Matte(shape.a * lambert, shape.b * lambert, wo, 1.0 / max(wo.z, MIN_COSINE));
}

// s = wi·wo − cosθi cosθo, t = max(cosθi, cosθo); cosθi/t is taken first, since t alone may be 1e-5.
vec3 matte_eval_cos(Matte m, vec3 wi) {
    float cos_i = max(wi.z, 0.0);
    if (!ROUGH_MATTE) {
        return m.flat_part * cos_i;
    }
    float s = max(wi.x * m.wo.x + wi.y * m.wo.y, 0.0);
    return m.flat_part * cos_i + m.rough_part * (s * min(cos_i * m.inv_cos_o, 1.0));
}

#endif
