// Asks bind/hit.glsl, unchanged, about rows of rays: the tests compare hits and surfaces with the oracle's.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require

#include "shared.glsl"

layout(constant_id = 1) const bool ANISOTROPIC = false;

#include "bind/hit.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { RayProbeRow rows[]; };
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { HitProbeRow values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    RayProbeRow row = rows[i];
    vec3 origin = offset_origin(row.origin, row.normal, row.way);
    Hit hit = nearest_hit(origin, row.direction, row.t_max);
    HitSurface s = hit_surface(hit, row.direction);
    BsdfParameters p = s.parameters;
    mat3 frame = s.world_from_local;
    values[i] = HitProbeRow(s.position, hit.t, s.geometric_normal, hit.triangle, frame[0], uint(hit.front),
            frame[1], uint(s.drawn), frame[2], s.model, vec4(p.color, p.alpha_x), vec4(p.specular, p.alpha_y),
            vec4(p.sigma, p.eta, p.metallic, p.roughness),
            vec4(p.specular_tint, p.sheen, p.sheen_tint, p.clearcoat),
            vec4(p.clearcoat_gloss, p.subsurface, hit.weights));
}
