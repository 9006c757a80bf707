// Asks bind/bvh.glsl, unchanged, about rows of rays: the tests compare the answers with brute force.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require

#include "shared.glsl"
#include "bind/bvh.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { RayProbeRow rows[]; };
// 1 where something is in the way.
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { uint values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    RayProbeRow row = rows[i];
    vec3 origin = offset_origin(row.origin, row.normal, row.way);
    values[i] = uint(occluded(origin, row.direction, row.t_min, row.t_max));
}
