// Feeds rows of material, wo and wi through lib/bsdf.glsl, unchanged: the tests compare f with `reference` and pbrt.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shared.glsl"

layout(constant_id = 0) const uint MODEL = MODEL_MATTE;
layout(constant_id = 1) const bool ANISOTROPIC = true;
layout(constant_id = 3) const bool ROUGH_MATTE = true;
layout(constant_id = 4) const bool LOBE_SHEEN = true;
layout(constant_id = 5) const bool LOBE_CLEARCOAT = true;
layout(constant_id = 6) const bool LOBE_SUBSURFACE = true;
layout(constant_id = 7) const bool LOBE_METALLIC = true;

#include "lib/bsdf.glsl"
#include "probe/bsdf_row.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { BsdfProbeRow rows[]; };
// f rgb without the cosine, and 0.
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec4 values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    BsdfProbeRow row = rows[i];
    BsdfParameters p = row_parameters(row);
    values[i] = vec4(bsdf_eval(bsdf_setup(p, row.wo.xyz), row.wi.xyz), 0.0);
}
