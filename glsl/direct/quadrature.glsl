// Quadrature of one lobe over a light of uniform or textured radiance 1, in the lobe's coordinates: see
// lib/area/quadrature.glsl.
#ifndef DIRECT_QUADRATURE_GLSL
#define DIRECT_QUADRATURE_GLSL

#include "lib/area/outline.glsl"
#include "lib/area/strip.glsl"

// `seen` has the nodes of azimuth; of each, so many along θ.
vec3 outline_quadrature(Receiver r, Source source, Outline outline, Seen seen, Proxy proxy, uint lobe, uint radial_nodes) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < seen.azimuths.panels * seen.nodes; ++k) {
        vec2 azimuth = outline_azimuth(outline, seen, k);
        vec2 e = vec2(cos(azimuth.x), sin(azimuth.x));
        vec2 interval = outline_interval(outline, seen, proxy, e);
        if (!(interval.y > interval.x)) continue;
        for (uint j = 0u; j < radial_nodes; ++j) {
            vec2 radial = gauss(radial_nodes, j);
            Point point = interval_point(proxy, e, interval, radial.x, radial.y * azimuth.y);
            vec3 f_cos = bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, lobe);
            if (source_textured(source)) f_cos *= source_texture(source, point.wi, point.weight);
            sum += point.weight * f_cos;
        }
    }
    return sum;
}

// Nodes across and along; two across are enough of four where the strip is narrow.
vec3 strip_quadrature(Receiver r, Strip strip, Proxy proxy, uint lobe, uvec2 nodes) {
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
            sum += point.weight * bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, lobe);
        }
    }
    return sum;
}

#endif
