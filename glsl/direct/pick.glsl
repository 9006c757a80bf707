// How much of an area light's reflection arrives: the ratio estimator of Heitz, Hill and McGuire 2018. One ray per lobe
// goes to a direction drawn in proportion to what the lobe reflects from there, so that the mean of the answers is the
// lit share itself; where nothing is in the way, every answer is 1 and the colour has no noise.
#ifndef DIRECT_PICK_GLSL
#define DIRECT_PICK_GLSL

#include "bind/bvh.glsl"
#include "lib/random.glsl"

// Directions among which one is drawn, per piece of a light: one in each sector of azimuth.
const uint CANDIDATES = 8u;

// A weighted draw from a stream (reservoir of one).
struct Pick {
    float total;
    vec3 wi;
    vec3 xi;  // sector, place along θ, draw; in [0, 1)
};

// The same pixel, light and lobe get well-spread numbers over the samples of a picture.
Pick pick_begin(uint light, uint lobe) {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint seed = hash(hash(hash(pixel.x) ^ pixel.y) ^ (light * LOBES + lobe));
    return Pick(0.0, vec3(0.0, 0.0, 1.0), spread(seed, frame.sample_index));
}

void pick_offer(inout Pick pick, vec3 wi, float weight) {
    if (!(weight > 0.0)) return;
    pick.total += weight;
    float share = weight / pick.total;
    // The number that decided is used again, stretched back to [0, 1).
    if (pick.xi.z < share) {
        pick.wi = wi;
        pick.xi.z = pick.xi.z / share;
    } else {
        pick.xi.z = (pick.xi.z - share) / max(1.0 - share, 1e-7);
    }
}

void pick_over_outline(inout Pick pick, Receiver r, Source source, Outline outline, Proxy proxy, uint lobe) {
    Seen seen = outline_seen(outline, proxy);
    float begin = seen.azimuths.edges[0];
    float extent = seen.azimuths.edges[seen.azimuths.panels] - begin;
    float width = extent / float(CANDIDATES);
    for (uint k = 0u; k < CANDIDATES; ++k) {
        float phi = begin + width * (float(k) + pick.xi.x);
        vec2 e = vec2(cos(phi), sin(phi));
        vec2 interval = outline_interval(outline, seen, proxy, e);
        if (!(interval.y > interval.x)) continue;
        Point point = interval_point(proxy, e, interval, fract(pick.xi.y + float(k) * 0.618034), width);
        vec3 f_cos = bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, lobe);
        if (source_textured(source)) f_cos *= source_texture(source, point.wi, point.weight);
        pick_offer(pick, point.wi, luminance(f_cos) * point.weight);
    }
}

void pick_over_strip(inout Pick pick, Receiver r, Strip strip, Proxy proxy, uint lobe) {
    StripImage image = strip_image(strip, proxy);
    float width = image.longitudes.y - image.longitudes.x;
    for (uint k = 0u; k < CANDIDATES; ++k) {
        float across = fract(pick.xi.y + float(k) * 0.618034);
        Meridian meridian = strip_meridian(image, image.longitudes.x + across * width);
        float along = (float(k) + pick.xi.x) / float(CANDIDATES);
        Point point = meridian_point(proxy, image, meridian, along, abs(width));
        vec3 f_cos = bsdf_eval_lobe_cos(r.surface.bsdf, point.wi, lobe);
        pick_offer(pick, point.wi, luminance(f_cos) * point.weight);
    }
}

// 0 where something is in the way, else 1.
float pick_visibility(Pick pick, Receiver r, Source source) {
    if (!(pick.total > 0.0)) return 1.0;
    float distance = source_distance(source, pick.wi);
    vec3 direction = r.surface.world_from_local * pick.wi;
    // Short of the light, which may be in the tree itself.
    return occluded(r.shadow_origin, direction, 0.0, distance * (1.0 - 1e-4)) ? 0.0 : 1.0;
}

#endif
