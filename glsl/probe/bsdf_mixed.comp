// Feeds rows of any model through lib/bsdf.glsl and what lib/bsdf/ adds to it for paths, unchanged, with the model known at
// run time only, as a shader that meets every material in one dispatch has it.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shared.glsl"

layout(constant_id = 70) const uint BSDF_PROBE = BSDF_PROBE_EVAL;

#include "lib/bsdf/mixed.glsl"
#include "lib/bsdf.glsl"
#include "lib/bsdf/lambert.glsl"
#include "lib/bsdf/packed.glsl"
#include "lib/bsdf/sample.glsl"
#include "probe/bsdf_row.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { BsdfProbeRow rows[]; };
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec4 values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    BsdfProbeRow row = rows[i];
    BsdfParameters p = row_parameters(row);
    surface_model = uint(row.rest.z);
    if (BSDF_PROBE == BSDF_PROBE_LAMBERT) {
        values[i] = vec4(bsdf_lambert(p), 0.0);
        return;
    }
    if (BSDF_PROBE == BSDF_PROBE_PACKED) {
        PackedBsdf packed = bsdf_pack(p, surface_model);
        surface_model = bsdf_unpack_model(packed);
        p = bsdf_unpack(packed);
    }
    BsdfSampling sampling = bsdf_sampling(p, row.wo.xyz);
    if (BSDF_PROBE == BSDF_PROBE_SAMPLE) {
        vec3 wi = bsdf_sample(sampling, row.wi.xy);
        values[i] = vec4(wi, bsdf_pdf(sampling, wi));
        return;
    }
    values[i] = vec4(bsdf_eval(bsdf_setup(p, row.wo.xyz), row.wi.xyz), bsdf_pdf(sampling, row.wi.xyz));
}
