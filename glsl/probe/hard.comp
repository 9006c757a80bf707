// Formulas of BSDFs that break in float32: as they are usually written, and as they ship in lib/.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shared.glsl"

layout(constant_id = 71) const uint HARD_FORMULA = HARD_DISTRIBUTION;

const uint MODEL = MODEL_PRINCIPLED;
const bool ANISOTROPIC = false;
const bool ROUGH_MATTE = true;
const bool LOBE_SHEEN = true;
const bool LOBE_CLEARCOAT = true;
const bool LOBE_SUBSURFACE = true;
const bool LOBE_METALLIC = true;

#include "lib/bsdf.glsl"
#include "lib/frame.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { HardProbeRow rows[]; };
// As usual, as shipped.
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec2 values[]; };

float naive_conductor(float eta, float k, float cos2) {
    float sin2 = 1.0 - cos2;
    float t0 = eta * eta - k * k - sin2;
    float m = sqrt(t0 * t0 + 4.0 * eta * eta * k * k);
    float ac2 = 2.0 * sqrt(0.5 * (m + t0)) * sqrt(cos2);
    float rs = (m + cos2 - ac2) / (m + cos2 + ac2);
    float p = cos2 * m + sin2 * sin2;
    return 0.5 * (rs + rs * (p - ac2 * sin2) / (p + ac2 * sin2));
}

float naive_dielectric(float eta, float cos2) {
    float c = sqrt(cos2);
    float t = sqrt(1.0 - (1.0 - cos2) / (eta * eta));
    float s = (c - eta * t) / (c + eta * t);
    float p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
}

float naive_visibility(float co, float ci, float alpha2) {
    float lambda_o = 0.5 * (sqrt(1.0 + alpha2 * (1.0 - co * co) / (co * co)) - 1.0);
    float lambda_i = 0.5 * (sqrt(1.0 + alpha2 * (1.0 - ci * ci) / (ci * ci)) - 1.0);
    return 2.0 * ci / ((1.0 + lambda_o + lambda_i) * 4.0 * ci * co);
}

float naive_subsurface(float ci, float co, float fss90) {
    float fss = mix(1.0, fss90, pow(1.0 - ci, 5.0)) * mix(1.0, fss90, pow(1.0 - co, 5.0));
    return fss * (1.0 / (ci + co) - 0.5) + 0.5;
}

float naive(HardProbeRow r) {
    vec3 wo = r.a.xyz, wi = r.b.xyz;
    vec3 h = normalize(wo + wi);
    float alpha2 = r.c.x * r.c.x;
    if (HARD_FORMULA == HARD_DISTRIBUTION) return sqr(alpha2 / (h.z * h.z * (alpha2 - 1.0) + 1.0));
    if (HARD_FORMULA == HARD_SCHLICK) return pow(1.0 - dot(wi, h), 5.0);
    if (HARD_FORMULA == HARD_HALF_COSINE) return dot(wi, h);
    if (HARD_FORMULA == HARD_VISIBILITY) return naive_visibility(wo.z, wi.z, alpha2);
    if (HARD_FORMULA == HARD_DIELECTRIC) return naive_dielectric(r.c.x, r.c.y);
    if (HARD_FORMULA == HARD_CONDUCTOR) return naive_conductor(r.c.x, r.c.y, r.c.z);
    if (HARD_FORMULA == HARD_COMPLEMENT) return 1.0 - pow(1.0 - r.c.x, 5.0);
    if (HARD_FORMULA == HARD_OREN_NAYAR) {
        return max(dot(wi, wo) - wi.z * wo.z, 0.0) / max(wi.z, wo.z) * wi.z;
    }
    if (HARD_FORMULA == HARD_CLEARCOAT) return 1.0 / (1.0 + (alpha2 - 1.0) * h.z * h.z);
    if (HARD_FORMULA == HARD_SUBSURFACE) return naive_subsurface(r.c.x, r.c.y, r.c.z);
    vec3 t = normalize(cross(vec3(0.0, 1.0, 0.0), wo));
    return dot(t, t);
}

float shipped(HardProbeRow r) {
    vec3 wo = r.a.xyz, wi = r.b.xyz;
    HalfVector h = half_vector(wo, wi);
    Ggx ggx = ggx_setup(r.c.x, r.c.x, wo);
    if (HARD_FORMULA == HARD_DISTRIBUTION) return ggx_distribution(ggx, h);
    if (HARD_FORMULA == HARD_SCHLICK) return schlick_weight(wo, wi, 0.5 * sqrt(h.length2));
    if (HARD_FORMULA == HARD_HALF_COSINE) return 0.5 * sqrt(h.length2);
    if (HARD_FORMULA == HARD_VISIBILITY) return ggx_visibility_correlated(ggx, wo.z, wi.z, wi);
    if (HARD_FORMULA == HARD_DIELECTRIC) return fresnel_dielectric((r.c.x - 1.0) * (r.c.x + 1.0), r.c.y);
    if (HARD_FORMULA == HARD_CONDUCTOR) {
        return fresnel_conductor(conductor_setup(vec3(r.c.x), vec3(r.c.y)), r.c.z).x;
    }
    if (HARD_FORMULA == HARD_COMPLEMENT) return schlick_complement(r.c.x);
    if (HARD_FORMULA == HARD_OREN_NAYAR) {
        return matte_eval_cos(Matte(vec3(0.0), vec3(1.0), wo, 1.0 / max(wo.z, MIN_COSINE)), wi).x;
    }
    if (HARD_FORMULA == HARD_CLEARCOAT || HARD_FORMULA == HARD_SUBSURFACE) {
        Principled m;
        m.coat = 1.0;
        m.coat_alpha2 = sqr(r.c.x);
        if (HARD_FORMULA == HARD_CLEARCOAT) {
            return principled_clearcoat(m, h, wi.z, 0.0) * clearcoat_shadowing(wi.z) / CLEARCOAT_F0;
        }
        m.cos_o = r.c.y;
        m.fresnel_o = pow5(1.0 - r.c.y);
        return principled_subsurface(m, r.c.x, pow5(1.0 - r.c.x), r.c.z);
    }
    vec3 t = any_tangent(wo);
    return dot(t, t);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) return;
    values[i] = vec2(naive(rows[i]), shipped(rows[i]));
}
