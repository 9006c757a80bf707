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

// What is seen of an open cylinder from `start` along `axis`: the strip between its tangent planes. Each end is an arc;
// the strip ends where it has the arc's area, two thirds of the way to the point that is nearest.
Outline outline_line(vec3 start, vec3 axis, float radius) {
    float length = sqrt(max(dot(axis, axis), TINY));
    vec3 e = axis / length;
    float first = dot(start, e);
    vec3 out_vector = start - first * e;
    float d = sqrt(dot(out_vector, out_vector));
    Cone cone = cone_begin();
    if (d > radius) {
        vec3 towards = out_vector / d;
        float ratio = radius / d;
        float rest = sqrt(max((1.0 - ratio) * (1.0 + ratio), 0.0));
        vec3 side = cross(e, towards) * (radius * rest);
        vec3 tangent = towards * (d * rest * rest);
        // √(d² − R²) / (d − R), how much farther along the axis the nearest point appears.
        float bulge = 1.0 + 2.0 / 3.0 * (sqrt((1.0 + ratio) / max(1.0 - ratio, 1e-6)) - 1.0);
        vec3 a = e * (first * bulge);
        vec3 b = e * ((first + length) * bulge);
        vec3 corners[4] = vec3[](tangent + side + a, tangent + side + b, tangent - side + b, tangent - side + a);
        for (uint i = 0u; i < 4u; ++i) cone_edge(cone, corners[i], corners[(i + 1u) & 3u]);
    }
    // From `side` to the axis to −`side`: clockwise as seen, whichever way the axis points.
    cone_close(cone, -1.0);
    return outline_polygon(cone);
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
    vec2 range = azimuths.circle ? vec2(0.0, PI) : ellipse_azimuths(ellipse);
    azimuths.edges[0] = range.x - range.y;
    azimuths.edges[1] = range.x + range.y;
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
    vec2 node = gauss(seen.nodes, k - panel * seen.nodes);
    if (ELLIPSES && outline.elliptic) {
        // All around, equal steps of a periodic function; else what grows as a root at both ends is smooth in x.
        float x = PI * node.x;
        node = seen.azimuths.circle ? vec2((float(k) + 0.5) / 12.0, 1.0 / 12.0)
                                    : vec2(0.5 - 0.5 * cos(x), 0.5 * PI * sin(x) * node.y);
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

// Irradiance of a uniform light over π times its radiance, in the space of a proxy: exact along θ.
float outline_form_factor(Outline outline, Proxy proxy) {
    Seen seen = outline_seen(outline, proxy);
    float sum = 0.0;
    for (uint k = 0u; k < seen.azimuths.panels * seen.nodes; ++k) {
        vec2 azimuth = outline_azimuth(outline, seen, k);
        vec2 e = vec2(cos(azimuth.x), sin(azimuth.x));
        vec2 interval = max(outline_interval(outline, seen, proxy, e), 0.0);
        sum += azimuth.y * max((interval.y - interval.x) * (interval.y + interval.x), 0.0);
    }
    return 0.5 * INV_PI * sum;
}

#endif
