// What a light covers, whatever its shape, for lib/area/quadrature.glsl: a convex piece of a polygon, or an ellipse cut by
// the horizon. Only the shapes that the scene has are compiled.
#ifndef LIB_AREA_OUTLINE_GLSL
#define LIB_AREA_OUTLINE_GLSL

#include "lib/area/cone.glsl"
#include "lib/area/ellipse.glsl"
#include "lib/area/quadrature.glsl"

struct Outline {
    bool elliptic;
    Cone cone;      // a polygon's piece; of an ellipse, the half space above the horizon
    vec3 center;    // of an ellipse, relative to the shaded point, local
    vec3 half_a;
    vec3 half_b;
};

Outline outline_polygon(Cone cone) { return Outline(false, cone, vec3(0.0), vec3(0.0), vec3(0.0)); }

Outline outline_ellipse(vec3 center, vec3 half_a, vec3 half_b) {
    Cone horizon;
    horizon.count = 1u;
    horizon.vertices[0] = vec3(0.0);
    horizon.planes[0] = vec3(0.0, 0.0, 1.0);
    return Outline(true, horizon, center, half_a, half_b);
}

// An outline in the space of a lobe's proxy, with the azimuths at which it is looked at.
struct Seen {
    EllipseCone ellipse;
    Azimuths azimuths;
    uint nodes;  // in a panel
};

Azimuths ellipse_range(EllipseCone ellipse) {
    Azimuths azimuths;
    azimuths.panels = 1u;
    azimuths.circle = ellipse_contains_axis(ellipse, 1.0) || ellipse_contains_axis(ellipse, -1.0);
    vec3 range = azimuths.circle ? vec3(1.0, 0.0, PI) : ellipse_azimuths(ellipse);
    float middle = atan(range.y, range.x);
    azimuths.edges[0] = middle - range.z;
    azimuths.edges[1] = middle + range.z;
    return azimuths;
}

Seen outline_seen(Outline outline, Proxy proxy) {
    Seen seen;
    if (ELLIPSES && outline.elliptic) {
        mat3 q = proxy.q_from_local;
        seen.ellipse = ellipse_cone(q * outline.center, q * outline.half_a, q * outline.half_b);
        seen.azimuths = ellipse_range(seen.ellipse);
        seen.nodes = 12u;
    } else {
        seen.azimuths = cone_azimuths(outline.cone, proxy);
        // Many panels are narrow, and need fewer nodes each.
        seen.nodes = outline.cone.count > 5u ? 2u : 4u;
    }
    return seen;
}

// Azimuth and weight of node k of all panels.
vec2 outline_azimuth(Outline outline, Seen seen, uint k) {
    uint panel = k / seen.nodes;
    float begin = seen.azimuths.edges[panel];
    float extent = seen.azimuths.edges[panel + 1u] - begin;
    // All around an ellipse, equal steps of a periodic function, as many as wanted.
    bool even = ELLIPSES && outline.elliptic && seen.azimuths.circle;
    vec2 node = even ? vec2(float(k) + 0.5, 1.0) / float(seen.nodes) : gauss(seen.nodes, k - panel * seen.nodes);
    if (ELLIPSES && outline.elliptic && !even) {
        // What grows as a root at both ends is smooth in x.
        float x = PI * node.x;
        node = vec2(0.5 - 0.5 * cos(x), 0.5 * PI * sin(x) * node.y);
    }
    return vec2(begin + node.x * extent, node.y * extent);
}

// As `cone_interval`.
vec2 outline_interval(Outline outline, Seen seen, Proxy proxy, vec2 e) {
    vec2 interval = cone_interval(outline.cone, proxy, e);
    if (ELLIPSES && outline.elliptic) {
        vec2 inside = ellipse_interval(seen.ellipse, e);
        interval = vec2(max(interval.x, inside.x), min(interval.y, inside.y));
    }
    return interval;
}

// The point at `along` of [0, 1] of an interval of cosθ; `width` is its share of azimuth. Evenly in u = ((1 + cosθ)/2)²,
// which a density of (1 + cosθ)/2 over the whole sphere makes uniform: a lobe has tails behind its cosine's horizon.
Point interval_point(Proxy proxy, vec2 e, vec2 interval, float along, float width) {
    vec2 half_cos = 0.5 + 0.5 * interval;
    float u = mix(sqr(half_cos.y), sqr(half_cos.x), along);
    float g = sqrt(u);
    vec3 q = vec3(2.0 * sqrt(max(g - u, 0.0)) * e, 2.0 * g - 1.0);
    // u₂ − u₁ by factors: the squares of a far light's interval would cancel. dcosθ = du / g.
    float du = (half_cos.y - half_cos.x) * (half_cos.y + half_cos.x);
    return point_of(proxy, q, width * du / max(g, 1e-4));
}

#endif
