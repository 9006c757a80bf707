// Ellipses as cones from the origin: what azimuths around z they span, and which interval of each.
//
// Both are where a quadratic form of (sin, cos) is not negative, a sinusoid of the doubled angle: one root and one
// arctangent, with no polynomial to solve and nothing that a small or thin ellipse could divide by.
#ifndef LIB_AREA_ELLIPSE_GLSL
#define LIB_AREA_ELLIPSE_GLSL

#include "lib/math.glsl"

// Center c, half axes a and b: any three vectors, as a linear map leaves them.
struct EllipseCone {
    vec3 center;
    vec3 half_a;
    vec3 half_b;
    // ω = α a + β b + γ c up to a positive factor: rows (α, β, γ). Inside, α² + β² ≤ γ² and γ > 0.
    vec3 rows[3];
};

EllipseCone ellipse_cone(vec3 c, vec3 a, vec3 b) {
    vec3 area = cross(a, b);
    float turn = dot(area, c) < 0.0 ? -1.0 : 1.0;
    vec3 ra = turn * cross(b, c);
    vec3 rb = turn * cross(c, a);
    vec3 rc = turn * area;
    float scale = inversesqrt(max(max(dot(ra, ra), dot(rb, rb)), TINY));
    return EllipseCone(c, a, b, vec3[](ra * scale, rb * scale, rc * scale));
}

// Whether `sign` times +z is inside.
bool ellipse_contains_axis(EllipseCone cone, float sign) {
    vec3 at = sign * vec3(cone.rows[0].z, cone.rows[1].z, cone.rows[2].z);
    return at.z > 0.0 && sqr(at.x) + sqr(at.y) <= sqr(at.z);
}

// Where x sin² + 2 y sin cos + z cos² ≥ 0: the middle of one of the two arcs, and half its width; −1 where nowhere.
vec2 positive_arc(float x, float y, float z) {
    float d2 = y * y - x * z;
    if (!(d2 > 0.0)) return vec2(0.0, -1.0);
    return 0.5 * vec2(atan(2.0 * y, z - x), atan(2.0 * sqrt(d2), -(x + z)));
}

// Middle and half width of the azimuths, for a cone without ±z inside: between the tangents from the origin to the
// ellipse as seen along z.
vec2 ellipse_azimuths(EllipseCone cone) {
    vec2 c = cone.center.xy;
    vec2 a = cone.half_a.xy;
    vec2 b = cone.half_b.xy;
    // With n = (−sin, cos): (a·n)² + (b·n)² ≥ (c·n)².
    float x = dot(vec3(a.x, b.x, c.x) * vec3(1.0, 1.0, -1.0), vec3(a.x, b.x, c.x));
    float y = -dot(vec3(a.x, b.x, c.x) * vec3(1.0, 1.0, -1.0), vec3(a.y, b.y, c.y));
    float z = dot(vec3(a.y, b.y, c.y) * vec3(1.0, 1.0, -1.0), vec3(a.y, b.y, c.y));
    vec2 arc = positive_arc(x, y, z);
    // Of the two opposite arcs, the one with the center in it.
    if (cos(arc.x) * c.x + sin(arc.x) * c.y < 0.0) arc.x += PI;
    return vec2(arc.x, max(arc.y, 0.0));
}

// Least and greatest cosθ at the azimuth of the unit vector e; the first is the greater where the cone is missed.
vec2 ellipse_interval(EllipseCone cone, vec2 e) {
    vec3 along = vec3(dot(cone.rows[0].xy, e), dot(cone.rows[1].xy, e), dot(cone.rows[2].xy, e));
    vec3 axis = vec3(cone.rows[0].z, cone.rows[1].z, cone.rows[2].z);
    vec3 form = vec3(-1.0, -1.0, 1.0);
    vec2 arc = positive_arc(dot(along * form, along), dot(along * form, axis), dot(axis * form, axis));
    if (arc.y < 0.0) return vec2(1.0, -1.0);
    // Of the two opposite arcs, the one before the origin; it may begin beyond ±z, at the opposite azimuth.
    if (sin(arc.x) * along.z + cos(arc.x) * axis.z < 0.0) arc.x += arc.x > 0.0 ? -PI : PI;
    float low = arc.x - arc.y;
    float high = arc.x + arc.y;
    if (low < -PI) {
        low += 2.0 * PI;
        high = PI;
    }
    low = max(low, 0.0);
    high = min(high, PI);
    return low < high ? vec2(cos(high), cos(low)) : vec2(1.0, -1.0);
}

#endif
