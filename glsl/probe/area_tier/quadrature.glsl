// Quadrature in the lobe's coordinates, with fewer or more nodes than direct/estimate.glsl takes.
#ifndef PROBE_AREA_TIER_QUADRATURE_GLSL
#define PROBE_AREA_TIER_QUADRATURE_GLSL

#include "direct/quadrature.glsl"
#include "probe/area_tier/closed_form.glsl"

// Nodes along azimuth (of a polygon, a panel's) and along θ, by TIER_POINTS = 2, 4 (what ships), 8.
uvec2 node_counts(Source source) {
    uint level = TIER_POINTS == 2u ? 0u : TIER_POINTS == 4u ? 1u : 2u;
    if (LINES && source.light.kind == AREA_LINE) return uvec2(2u << level, level == 0u ? 4u : level == 1u ? 8u : 12u);
    if (ELLIPSES && source.light.kind == AREA_ELLIPSE) return uvec2(level == 0u ? 4u : 12u, level < 2u ? 2u : 4u);
    return uvec2(2u << level, level < 2u ? 2u : 4u);
}

// A rectangle or an ellipse, cut by the horizon.
Outline outline_of(Source source) {
    if (ELLIPSES && source.light.kind == AREA_ELLIPSE) return outline_ellipse(source.center, source.u, source.v);
    Cone cone = cone_begin();
    vec3 corners[4] = vec3[](source.center - source.u - source.v, source.center + source.u - source.v,
                             source.center + source.u + source.v, source.center - source.u + source.v);
    for (uint i = 0u; i < 4u; ++i) cone_edge(cone, corners[i], corners[(i + 1u) & 3u]);
    cone_close(cone, source.front ? -1.0 : 1.0);
    return outline_polygon(cone);
}

vec3 quadrature(Receiver r, Source source) {
    uvec2 nodes = node_counts(source);
    Proxy proxy = r.specular.proxy;
    vec3 specular = vec3(0.0);
    if (LINES && source.light.kind == AREA_LINE) {
        Strip strip = strip_of_line(source.center, source.u, source.light.radius);
        if (strip.seen) specular = strip_quadrature(r, strip, proxy, LOBE_SPECULAR, nodes);
    } else {
        Outline outline = outline_of(source);
        Seen seen = outline_seen(outline, proxy);
        seen.nodes = nodes.x;
        if (outline.elliptic || outline.cone.count > 2u) {
            specular = outline_quadrature(r, source, outline, seen, proxy, LOBE_SPECULAR, nodes.y);
        }
    }
    return specular * source.light.radiance + diffuse_closed_form(r, source);
}

#endif
