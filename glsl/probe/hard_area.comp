// Formulas of area lights that break in float32: as they are usually written, and as they ship in lib/area/.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shared.glsl"

layout(constant_id = 71) const uint HARD_FORMULA = HARD_FORM_FACTOR;

#include "probe/hard_area/shapes.glsl"
#include "probe/hard_area/shipped.glsl"
#include "probe/hard_area/usual.glsl"
#include "probe/hard_area/usual_ellipse.glsl"

layout(local_size_x = LINEAR_GROUP) in;

layout(set = SET_probe, binding = PROBE_IN, std430) readonly buffer Rows { HardProbeRow rows[]; };
// As usual, as shipped.
layout(set = SET_probe, binding = PROBE_OUT, std430) writeonly buffer Values { vec2 values[]; };

vec2 of_polygon(Ring ring) { return vec2(usual_polygon(ring), shipped_polygon(ring)); }

vec2 of_parts(HardProbeRow r) {
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < 4u; ++i) sum += of_polygon(quarter(r, i));
    return sum;
}

vec2 of_furnace(HardProbeRow r) {
    mat3 shipped = shipped_map(r), usual = usual_map(r);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < 5u; ++i) {
        Ring side = cube_side(i);
        sum += vec2(usual_polygon(mapped(usual, side)), shipped_polygon(mapped(shipped, side)));
    }
    return sum;
}

vec2 of_row(HardProbeRow r) {
    if (HARD_FORMULA == HARD_FORM_FACTOR) return of_polygon(quadrilateral(r));
    if (HARD_FORMULA == HARD_PARTS) return of_parts(r);
    if (HARD_FORMULA == HARD_NOTCH) return of_polygon(notched(r));
    if (HARD_FORMULA == HARD_HOLE) return vec2(usual_hole(r), shipped_hole(r));
    if (HARD_FORMULA == HARD_ELLIPSE) return vec2(usual_ellipse(r), ellipse_form_factor(r.a.xyz, r.b.xyz, r.c.xyz));
    if (HARD_FORMULA == HARD_LINE) return vec2(usual_line(r), shipped_line(r));
    if (HARD_FORMULA == HARD_FURNACE) return of_furnace(r);
    return vec2(usual_incidence(r), shipped_incidence(r));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rows.length()) return;
    values[i] = of_row(rows[i]);
}
