// Times and judges ways to light a surface by one area light: those that ship, from glsl/direct/ unchanged, and others to
// hold against them. A row is a surface and its lights; where time counts all invocations of a workgroup share it, as
// neighbouring pixels nearly do, and differ in their random numbers only.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require

#include "shared.glsl"

layout(constant_id = 0) const uint MODEL = MODEL_MATTE;
layout(constant_id = 1) const bool ANISOTROPIC = false;
layout(constant_id = 3) const bool ROUGH_MATTE = false;
layout(constant_id = 4) const bool LOBE_SHEEN = false;
layout(constant_id = 5) const bool LOBE_CLEARCOAT = false;
layout(constant_id = 6) const bool LOBE_SUBSURFACE = false;
layout(constant_id = 7) const bool LOBE_METALLIC = false;
// Which way, TIER_*, and how many points it takes, or which error in thousandths it may make.
layout(constant_id = 40) const uint TIER = TIER_NONE;
layout(constant_id = 41) const uint TIER_POINTS = 1u;
layout(constant_id = 42) const uint TIER_INVOCATIONS = LINEAR_GROUP;

#include "lib/bsdf.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { AreaTierRow rows[]; };
// A row of values for each invocation: radiance of each light.
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec4 values[]; };

// What glsl/direct/ asks of bind/frame.glsl and bind/surface.glsl, answered from the row.
#define BIND_SURFACE_GLSL
#define gl_FragCoord vec4(0.0)
#define dFdx(x) (x)
#define dFdy(x) (x)
FrameConstants frame;
AreaTierRow row;

struct Surface {
    vec3 position;
    mat3 world_from_local;
    Bsdf bsdf;
};

BsdfParameters surface_parameters() {
    BsdfParameters p;
    p.color = row.color_alpha.rgb;
    p.specular = row.specular_eta.rgb;
    p.alpha_x = row.color_alpha.w;
    p.alpha_y = row.color_alpha.w;
    p.sigma = 0.0;
    p.eta = row.specular_eta.w;
    p.metallic = 0.0;
    p.roughness = sqrt(row.color_alpha.w);
    p.specular_tint = 0.0;
    p.sheen = 0.0;
    p.sheen_tint = 0.0;
    p.clearcoat = 0.0;
    p.clearcoat_gloss = 0.0;
    p.subsurface = 0.0;
    return p;
}

vec3 view_direction() { return row.wo; }

Surface surface_here() { return Surface(row.position, mat3(1.0), bsdf_setup(surface_parameters(), row.wo)); }

#include "direct/estimate.glsl"
#include "probe/area_tier/closed_form.glsl"
#include "probe/area_tier/quadrature.glsl"
#include "probe/area_tier/representative.glsl"
#include "probe/area_tier/samples.glsl"

// Only what is loaded in any case, so that it can be subtracted.
vec3 nothing(Receiver r, Source s) {
    return s.light.radiance * s.size + s.center + s.u + s.v + s.normal * r.narrowest;
}

vec3 cubature(Receiver r, Source source) {
    Estimate sum;
    for (uint lobe = 0u; lobe < LOBES; ++lobe) sum.lobes[lobe] = vec3(0.0);
    // The size decides between the coarse and the fine points.
    source.size = TIER_POINTS == 4u ? -1.0 : 1e30;
    by_cubature(sum, r, source, vec3(1.0));
    vec3 reflected = vec3(0.0);
    for (uint lobe = 0u; lobe < LOBES; ++lobe) {
        if (bsdf_has(lobe)) reflected += sum.lobes[lobe];
    }
    return reflected;
}

vec3 by_tier(Receiver r, uint light, uint seed) {
    if (TIER == TIER_SHIPPED) return area_reflected(r, light);
    Source source = source_of(area_light(light), r.surface);
    if (!source_shines(source)) return vec3(0.0);
    if (TIER == TIER_REPRESENTATIVE) return representative(r, source);
    if (TIER == TIER_CUBATURE) return cubature(r, source);
    if (TIER == TIER_CLOSED_FORM) return closed_form(r, source);
    if (TIER == TIER_QUADRATURE) return quadrature(r, source);
    if (TIER == TIER_AREA_SAMPLES) return area_samples(r, source, seed);
    if (TIER == TIER_PROXY_SAMPLES) return proxy_samples(r, source, seed);
    return nothing(r, source);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= TIER_INVOCATIONS * rows.length()) return;
    row = rows[i / TIER_INVOCATIONS];
    frame.sample_index = 0u;
    frame.light_error = 1e-3 * float(TIER_POINTS);
    Receiver r = receiver_here();
    for (uint k = 0u; k < row.light_count; ++k) {
        uint at = i * TIER_LIGHTS + k;
        values[at] = vec4(by_tier(r, row.light_first + k, hash(at ^ 0x9e3779b9u)), 0.0);
    }
}
