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
    vec3 axis;
    vec3 side;
    vec3 away;      // from the origin to the axis
    float start;    // along the axis, from the foot of the origin
    float end;
    vec2 tangent;   // of a tangent point: from the origin's plane of axis and side, and along side
    vec2 inner;     // of a point between
};

Line line_setup(vec3 a, vec3 b, float radius) {
    Line line;
    line.axis = (b - a) * inversesqrt(max(dot(b - a, b - a), LEAST_SQUARE));
    line.start = dot(a, line.axis);
    line.end = dot(b, line.axis);
    // From the nearer end, which loses the fewest digits.
    vec3 to_axis = cross(line.axis, cross(dot(a, a) < dot(b, b) ? a : b, line.axis));
    float d2 = dot(to_axis, to_axis);
    float inverse_d = inversesqrt(max(d2, LEAST_SQUARE));
    float d = d2 * inverse_d;
    line.visible = d > radius && radius > 0.0 && a != b;
    line.away = to_axis * inverse_d;
    line.side = cross(line.away, line.axis);
    float cosine = min(radius * inverse_d, 1.0);
    float sine = sqrt(max((d - radius) * (d + radius), 0.0)) * inverse_d;
    line.tangent = vec2(max(d - radius, 0.0) * (1.0 + cosine), radius * sine);
    // Of a segment of angle 3 third on either side, the trapezoid's area: scale²/2 + scale = 3 third / sin(2 third).
    float third = max(angle_of(sine, cosine) / 3.0, LEAST_SQUARE);
    vec2 turn = cos_sin(third);
    float scale = sqrt(1.0 + 3.0 * third / (turn.x * max(turn.y, LEAST_SQUARE))) - 1.0;
    line.inner = vec2(max(d - radius, 0.0) + radius * max(1.0 - scale * turn.x, 0.0), radius * scale * turn.y);
    return line;
}

// Vertex i of LINE_VERTICES, counter-clockwise as the origin sees the light: 0–3 the rim at a, 4–7 that at b. A point
// closer to the surface than float32 tells at the ends is as far as it does: directions move by less than 1e-6.
vec3 line_vertex(Line line, uint i) {
    bool at_end = i >= 4u;
    uint k = at_end ? 7u - i : i;
    float along = at_end ? line.end : line.start;
    vec2 across = k == 0u || k == 3u ? line.tangent : line.inner;
    return along * line.axis + max(across.x, 1e-6 * abs(along)) * line.away + (k < 2u ? -across.y : across.y) * line.side;
}

#endif
