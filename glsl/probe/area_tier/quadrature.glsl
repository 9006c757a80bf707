// Quadrature in the lobe's coordinates as direct/estimate.glsl has it, with fewer or more nodes than ship.
#ifndef PROBE_AREA_TIER_QUADRATURE_GLSL
#define PROBE_AREA_TIER_QUADRATURE_GLSL

#include "lib/area/outline.glsl"
#include "lib/area/strip.glsl"
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

// As `outline_azimuth`, for any number of nodes around an ellipse.
vec2 azimuth_node(Outline outline, Seen seen, uint k) {
    if (!(ELLIPSES && outline.elliptic)) return outline_azimuth(outline, seen, k);
    float begin = seen.azimuths.edges[0];
    float extent = seen.azimuths.edges[1] - begin;
    vec2 node = gauss(seen.nodes, k);
    float x = PI * node.x;
    node = seen.azimuths.circle ? vec2((float(k) + 0.5), 1.0) / float(seen.nodes)
                                : vec2(0.5 - 0.5 * cos(x), 0.5 * PI * sin(x) * node.y);
    return vec2(begin + node.x * extent, node.y * extent);
}

vec3 outline_quadrature(Receiver r, Outline outline, uvec2 nodes) {
    Proxy proxy = r.specular.proxy;
    Seen seen = outline_seen(outline, proxy);
    seen.nodes = nodes.x;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < seen.azimuths.panels * seen.nodes; ++k) {
        vec2 azimuth = azimuth_node(outline, seen, k);
        vec2 e = vec2(cos(azimuth.x), sin(azimuth.x));
        vec2 interval = outline_interval(outline, seen, proxy, e);
        if (!(interval.y > interval.x)) continue;
        for (uint j = 0u; j < nodes.y; ++j) {
            vec2 radial = gauss(nodes.y, j);
            Point point = interval_point(proxy, e, interval, radial.x, radial.y * azimuth.y);
            sum += point.weight * bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, LOBE_SPECULAR);
        }
    }
    return sum;
}

vec3 strip_quadrature(Receiver r, Source source, uvec2 nodes) {
    Proxy proxy = r.specular.proxy;
    Strip strip = strip_of_line(source.center, source.u, source.light.radius);
    if (!strip.seen) return vec3(0.0);
    StripImage image = strip_image(strip, proxy);
    float width = image.longitudes.y - image.longitudes.x;
    uint meridians = nodes.x == 4u && abs(width) < 0.1 ? 2u : nodes.x;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < meridians; ++k) {
        vec2 node = gauss(meridians, k);
        Meridian meridian = strip_meridian(image, image.longitudes.x + node.x * width);
        for (uint j = 0u; j < nodes.y; ++j) {
            vec2 along = gauss(nodes.y, j);
            Point point = meridian_point(proxy, image, meridian, along.x, abs(width) * node.y * along.y);
            sum += point.weight * bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, LOBE_SPECULAR);
        }
    }
    return sum;
}

vec3 quadrature(Receiver r, Source source) {
    uvec2 nodes = node_counts(source);
    vec3 specular = vec3(0.0);
    if (LINES && source.light.kind == AREA_LINE) {
        specular = strip_quadrature(r, source, nodes);
    } else {
        Outline outline = outline_of(source);
        if (outline.elliptic || outline.cone.count > 2u) specular = outline_quadrature(r, outline, nodes);
    }
    return specular * source.light.radiance + diffuse_closed_form(r, source);
}

#endif
