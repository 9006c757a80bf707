// Feeds rows of outlines, ellipses and cylinders through lib/area/, unchanged, one function a pipeline.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shared.glsl"

layout(constant_id = 39) const uint AREA_PROBE = PROBE_POLYGON;

#include "lib/area/ellipse.glsl"
#include "lib/area/ellipse_form_factor.glsl"
#include "lib/area/form_factor.glsl"
#include "lib/area/line.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { AreaProbeRow rows[]; };
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec4 values[]; };

// As a renderer calls it: relative to the center where the light is small.
float polygon(uint row) {
    vec3 center = rows[row].center;
    vec3 anchor = form_factor_anchor(center, rows[row].radius);
    vec3 base = center - anchor;
    FormFactor f = form_factor_begin(anchor);
    uint first = 0u;
    for (uint i = 0u; i < rows[row].count; i++) {
        vec4 vertex = rows[row].vertices[i];
        bool last = vertex.w > 0.0;
        vec3 next = rows[row].vertices[last ? first : i + 1u].xyz;
        form_factor_edge(f, base + vertex.xyz, base + next);
        if (last) {
            form_factor_close_ring(f);
            first = i + 1u;
        }
    }
    return form_factor_end(f);
}

float line_outline(vec3 a, vec3 b, float radius) {
    Line line = line_setup(a, b, radius);
    FormFactor f = form_factor_begin();
    for (uint i = 0u; i < LINE_VERTICES; i++) {
        form_factor_edge(f, line_vertex(line, i), line_vertex(line, (i + 1u) % LINE_VERTICES));
    }
    form_factor_close_ring(f);
    return line.visible ? form_factor_end(f) : 0.0;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) {
        return;
    }
    vec3 center = rows[i].center;
    vec3 a = rows[i].vertices[0].xyz, b = rows[i].vertices[1].xyz;
    vec4 value = vec4(0.0);
    if (AREA_PROBE == PROBE_POLYGON) {
        value.x = polygon(i);
    }
    if (AREA_PROBE == PROBE_ELLIPSE) {
        value = vec4(ellipse_form_factor(center, a, b), ellipse_azimuths(ellipse_cone(center, a, b)));
    }
    if (AREA_PROBE == PROBE_INTERVAL) {
        EllipseCone cone = ellipse_cone(center, a, b);
        value.xy = ellipse_interval(cone, rows[i].azimuth.xy);
        value.z = ellipse_contains_axis(cone, 1.0) ? 1.0 : 0.0;
        value.w = ellipse_contains_axis(cone, -1.0) ? 1.0 : 0.0;
    }
    if (AREA_PROBE == PROBE_LINE) {
        value.x = line_outline(center + a, center + b, rows[i].radius);
    }
    values[i] = value;
}
