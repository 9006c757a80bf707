// Line lights: the outside of an open cylinder, seen from the origin, as an outline on the sphere.
//
// Visible is the strip of surface between the two planes through the origin that touch the cylinder: its straight sides
// are exact. Its ends are arcs of the rims, which two points each stand for; between chords of equal angle they lie as
// far out as makes the area of the flat outline that of the rim. Inside the infinite cylinder nothing is seen: the
// cylinder has no caps and emits outwards only.
//
// Error of the form factor against the cylinder in double precision, relative to the mean, for 3,000 random cylinders of
// radius to axis distance 0–.1, .1–.3, .3–.6, .6–.9: 1.0e-4, 1.0e-3, 3.3e-3, 4.9e-3; with one point a rim instead of two
// 3.4e-4, 3.6e-3, 1.2e-2, 2.3e-2.
#ifndef LIB_AREA_LINE_GLSL
#define LIB_AREA_LINE_GLSL

#include "lib/area/angle.glsl"

const uint LINE_VERTICES = 8u;

struct Line {
    bool visible;
    vec3 start;
    vec3 end;
    // Offsets from the axis are out ± side, of the tangent points and of those between.
    vec3 tangent_out;
    vec3 tangent_side;
    vec3 inner_out;
    vec3 inner_side;
};

Line line_setup(vec3 a, vec3 b, float radius) {
    Line line;
    line.start = a;
    line.end = b;
    vec3 axis = (b - a) * inversesqrt(max(dot(b - a, b - a), LEAST_SQUARE));
    // From the nearer end, which loses the fewest digits.
    vec3 from_axis = cross(axis, cross(axis, dot(a, a) < dot(b, b) ? a : b));
    float axis2 = dot(from_axis, from_axis);
    float inverse_distance = inversesqrt(max(axis2, LEAST_SQUARE));
    float d = axis2 * inverse_distance;
    line.visible = d > radius && radius > 0.0 && a != b;
    vec3 out_ = from_axis * inverse_distance;
    vec3 side = cross(axis, out_);
    float cosine = min(radius * inverse_distance, 1.0);
    float sine = sqrt(max((d - radius) * (d + radius), 0.0)) * inverse_distance;
    float third = angle_of(sine, cosine) / 3.0;
    vec2 inner = cos_sin(third);
    // Of a segment of angle 3 third on either side, the trapezoid's area: scale²/2 + scale = 3 third / sin(2 third).
    float sine_of_two = 2.0 * inner.x * inner.y;
    float scale = sqrt(1.0 + 6.0 * max(third, LEAST_SQUARE) / max(sine_of_two, 2.0 * LEAST_SQUARE)) - 1.0;
    line.tangent_out = radius * cosine * out_;
    line.tangent_side = radius * sine * side;
    line.inner_out = radius * scale * inner.x * out_;
    line.inner_side = radius * scale * inner.y * side;
    return line;
}

// Vertex i of LINE_VERTICES, counter-clockwise as the origin sees the light: 0–3 the rim at a, 4–7 that at b.
vec3 line_vertex(Line line, uint i) {
    bool at_end = i >= 4u;
    uint k = at_end ? 7u - i : i;
    bool tangent = k == 0u || k == 3u;
    vec3 side = tangent ? line.tangent_side : line.inner_side;
    vec3 outward = tangent ? line.tangent_out : line.inner_out;
    return (at_end ? line.end : line.start) + (outward + (k < 2u ? -side : side));
}

#endif
