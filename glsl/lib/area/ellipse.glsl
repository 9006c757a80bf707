// Ellipse lights center + a cos ψ + b sin ψ by azimuth: what part of the half-plane at an azimuth around z they cover.
//
// a and b need not be orthogonal, since a linear map keeps neither. The half-plane through z and e = (cos φ, sin φ) cuts
// the ellipse in a chord, of which midpoint and half are exact for any size: nothing is squared and subtracted, and no
// K = (a b c)⁻¹ is formed. Directions are between the chord's ends.
#ifndef LIB_AREA_ELLIPSE_GLSL
#define LIB_AREA_ELLIPSE_GLSL

#include "lib/area/angle.glsl"

struct EllipseCone {
    vec3 center;
    vec3 a;
    vec3 b;
    float volume; // center·(a × b): the sign tells the side, 0 is edge-on
};

EllipseCone ellipse_cone(vec3 center, vec3 a, vec3 b) {
    return EllipseCone(center, a, b, dot(center, cross(a, b)));
}

// The half-axis +z (side 1) or −z (side −1) meets the ellipse.
bool ellipse_contains_axis(EllipseCone cone, float side) {
    float ab = cross_2d(cone.a.xy, cone.b.xy);
    float ca = cross_2d(cone.center.xy, cone.a.xy), cb = cross_2d(cone.center.xy, cone.b.xy);
    return ca * ca + cb * cb < ab * ab && side * cone.volume * ab > 0.0;
}

// Azimuths that meet the ellipse: their middle as a unit vector, and half their range in radians; π where the ellipse
// contains an axis. Towards either end an interval closes as a square root: Gauss–Chebyshev of the second kind.
vec3 ellipse_azimuths(EllipseCone cone) {
    vec2 c = cone.center.xy, a = cone.a.xy, b = cone.b.xy;
    float ab = cross_2d(a, b), ca = cross_2d(c, a), cb = cross_2d(c, b);
    float h2 = ca * ca + cb * cb;
    if (h2 < ab * ab) {
        return vec3(1.0, 0.0, PI);
    }
    // Tangents from the origin: r × r' = ab + cb cos ψ − ca sin ψ = 0.
    float h = sqrt(h2);
    float inverse_h2 = 1.0 / max(h2, LEAST_SQUARE);
    vec2 middle = c - (ab * inverse_h2) * (a * cb - b * ca);
    vec2 spread = (sqrt((h - abs(ab)) * (h + abs(ab))) * inverse_h2) * (a * ca + b * cb);
    vec2 from = middle - spread, to = middle + spread;
    from *= inversesqrt(max(dot(from, from), LEAST_SQUARE));
    to *= inversesqrt(max(dot(to, to), LEAST_SQUARE));
    // The bisector, of nearly opposite tangents by their difference; the center lies on its side.
    vec2 difference = to - from;
    vec2 normal = vec2(-difference.y, difference.x);
    vec2 bisector = dot(from, to) > 0.0 ? from + to : dot(normal, c) < 0.0 ? -normal : normal;
    bisector *= inversesqrt(max(dot(bisector, bisector), LEAST_SQUARE));
    float sine = 2.0 * abs(cross_2d(middle, spread));
    return vec3(bisector, 0.5 * angle_of(sine, dot(middle, middle) - dot(spread, spread)));
}

// The chord in the plane of z and e, in coordinates (along e, along z): midpoint, and half of it; the half is 0 where the
// plane misses. Its part with a positive first coordinate is the azimuth of e, the other that of −e.
vec4 ellipse_chord(EllipseCone cone, vec2 e) {
    float an = cross_2d(cone.a.xy, e), bn = cross_2d(cone.b.xy, e), cn = cross_2d(cone.center.xy, e);
    float h2 = an * an + bn * bn;
    float inverse_h2 = 1.0 / max(h2, LEAST_SQUARE);
    float h = sqrt(h2);
    float root = sqrt(max((h - abs(cn)) * (h + abs(cn)), 0.0)) * inverse_h2;
    vec3 middle = cone.center - (cn * inverse_h2) * (an * cone.a + bn * cone.b);
    vec3 half_chord = root * (an * cone.b - bn * cone.a);
    return vec4(dot(middle.xy, e), middle.z, dot(half_chord.xy, e), half_chord.z);
}

// cos θ at the lower and the upper end of the interval of θ ∈ [0, π] that the ellipse covers at the azimuth of e; the
// lower above the upper, (1, −1), where it covers none. Of a small light far from the axis the two cosines agree in all
// but their last digits: take ellipse_chord there.
vec2 ellipse_interval(EllipseCone cone, vec2 e) {
    vec4 chord = ellipse_chord(cone, e);
    vec2 from = chord.xy - chord.zw, to = chord.xy + chord.zw;
    if (max(from.x, to.x) <= 0.0 || chord.zw == vec2(0.0)) {
        return vec2(1.0, -1.0);
    }
    if (from.x < 0.0 || to.x < 0.0) {
        // Through the axis; positive weights, so the height keeps its digits.
        float z = (from.y * abs(to.x) + to.y * abs(from.x)) / (abs(from.x) + abs(to.x));
        vec2 on_axis = vec2(0.0, z);
        from = from.x < 0.0 ? on_axis : from;
        to = to.x < 0.0 ? on_axis : to;
    }
    float first = from.y * inversesqrt(max(dot(from, from), LEAST_SQUARE));
    float last = to.y * inversesqrt(max(dot(to, to), LEAST_SQUARE));
    return vec2(min(first, last), max(first, last));
}

#endif
