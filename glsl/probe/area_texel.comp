// Feeds rows of texture coordinates, level of detail and light through bind/area_lights.glsl, unchanged.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#include "shared.glsl"
#include "bind/area_lights.glsl"

layout(local_size_x = LINEAR_GROUP) in;

// u, v, level, index of the light.
layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { vec4 rows[]; };
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec4 values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    vec4 row = rows[i];
    values[i] = vec4(area_texel(area_light(uint(row.w)), row.xy, row.z), 0.0);
}
