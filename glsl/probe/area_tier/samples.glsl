// Independent random points: uniform over the light's area, or in the coordinates of each lobe.
#ifndef PROBE_AREA_TIER_SAMPLES_GLSL
#define PROBE_AREA_TIER_SAMPLES_GLSL

#include "lib/random.glsl"
#include "probe/area_tier/quadrature.glsl"
#include "probe/area_tier/representative.glsl"

vec2 random_pair(uint seed, uint index) {
    uint first = hash(seed + index * 0x9e3779b9u);
    return vec2(unit(first), unit(hash(first)));
}

vec3 area_samples(Receiver r, Source source, uint seed) {
    float area = source_area(source);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < TIER_POINTS; ++i) {
        vec2 xi = random_pair(seed, i);
        vec3 p = source.center;
        if (LINES && source.light.kind == AREA_LINE) {
            p += xi.x * source.u;
        } else if (ELLIPSES && source.light.kind == AREA_ELLIPSE) {
            float phi = TWO_PI * xi.y;
            p += sqrt(xi.x) * (cos(phi) * source.u + sin(phi) * source.v);
        } else {
            p += (2.0 * xi.x - 1.0) * source.u + (2.0 * xi.y - 1.0) * source.v;
        }
        float d2 = max(dot(p, p), TINY);
        vec3 wi = p * inversesqrt(d2);
        sum += source_projection(source, wi) / d2 * bsdf_eval_cos(r.surface.bsdf, wi);
    }
    return sum * (area / float(TIER_POINTS)) * source.light.radiance;
}

vec3 outline_samples(Receiver r, Outline outline, uint lobe, uint seed) {
    Proxy proxy = receiver_proxy(r, lobe);
    Seen seen = outline_seen(outline, proxy);
    float begin = seen.azimuths.edges[0];
    float extent = seen.azimuths.edges[seen.azimuths.panels] - begin;
    bool rounded = ELLIPSES && outline.elliptic && !seen.azimuths.circle;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < TIER_POINTS; ++i) {
        vec2 xi = random_pair(seed, i);
        float x = PI * xi.x;
        vec2 node = rounded ? vec2(0.5 - 0.5 * cos(x), 0.5 * PI * sin(x)) : vec2(xi.x, 1.0);
        float phi = begin + node.x * extent;
        vec2 e = vec2(cos(phi), sin(phi));
        vec2 interval = outline_interval(outline, seen, proxy, e);
        if (!(interval.y > interval.x)) continue;
        Point point = interval_point(proxy, e, interval, xi.y, node.y * extent);
        sum += point.weight * bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, lobe);
    }
    return sum;
}

vec3 strip_samples(Receiver r, Strip strip, uint lobe, uint seed) {
    Proxy proxy = receiver_proxy(r, lobe);
    StripImage image = strip_image(strip, proxy);
    float width = image.longitudes.y - image.longitudes.x;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < TIER_POINTS; ++i) {
        vec2 xi = random_pair(seed, i);
        Meridian meridian = strip_meridian(image, image.longitudes.x + xi.x * width);
        Point point = meridian_point(proxy, image, meridian, xi.y, abs(width));
        sum += point.weight * bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, lobe);
    }
    return sum;
}

// TIER_POINTS of each lobe.
vec3 proxy_samples(Receiver r, Source source, uint seed) {
    vec3 sum = vec3(0.0);
    if (LINES && source.light.kind == AREA_LINE) {
        Strip strip = strip_of_line(source.center, source.u, source.light.radius);
        if (!strip.seen) return vec3(0.0);
        for (uint lobe = 0u; lobe < LOBES; ++lobe) {
            if (bsdf_has(lobe)) sum += strip_samples(r, strip, lobe, hash(seed + lobe));
        }
    } else {
        Outline outline = outline_of(source);
        if (!outline.elliptic && outline.cone.count < 3u) return vec3(0.0);
        for (uint lobe = 0u; lobe < LOBES; ++lobe) {
            if (bsdf_has(lobe)) sum += outline_samples(r, outline, lobe, hash(seed + lobe));
        }
    }
    return sum * source.light.radiance / float(TIER_POINTS);
}

#endif
