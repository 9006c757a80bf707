// Only the walk of bind/nearest.glsl, for rows of rays: what a nearest hit takes.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require

#include "shared.glsl"
#include "bind/nearest.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { RayProbeRow rows[]; };
// Triangle, bits of the distance.
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { uvec2 values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    RayProbeRow row = rows[i];
    Hit hit = nearest_hit(row.origin, row.direction, row.t_max);
    values[i] = uvec2(hit.triangle, floatBitsToUint(hit.t));
}
