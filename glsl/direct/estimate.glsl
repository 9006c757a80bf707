// What one area light adds to a pixel, lobe by lobe, each by the cheapest estimator that is exact enough:
//
//   a light small against the lobe   cubature at points of the light's surface, which come with it
//   Lambert                          the form factor
//   a lobe that a transformed cosine fits within light_error   the form factor in the lobe's own coordinates
//   any other                        quadrature in these coordinates (direct/quadrature.glsl)
#ifndef DIRECT_ESTIMATE_GLSL
#define DIRECT_ESTIMATE_GLSL

#include "direct/receiver.glsl"
#include "direct/source.glsl"
#include "direct/closed_form.glsl"
#include "direct/quadrature.glsl"
#include "direct/pick.glsl"

// Between these ratios of a light's size to a lobe's width the cubature gives way; below the first of all, four points do.
const float POINT = 0.3;
const float SMALL = 1.0;
const float LARGE = 1.5;
const float CUT = 30.0;
// A line's points lie on its axis: they are right to the first order of its radius only.
const float THIN = 3.0;
// From this size on a light is no smaller than its distance, about.
const float NEAR = 0.7;

bool lambert() { return MODEL == MODEL_PLASTIC || (MODEL == MODEL_MATTE && !ROUGH_MATTE); }

// A light's share of each lobe, and the direction from which one ray asks how much of it arrives.
struct Estimate {
    vec3 lobes[LOBES];
    Pick picks[LOBES];
};

// What is hard takes more nodes: lobes that are stretched or seen at grazing angles, slivers, what is near or cut by the
// horizon, and textures, whose detail no proxy flattens.
vec3 lobe_by_quadrature(Receiver r, Source source, Outline outline, Proxy proxy, uint lobe) {
    Seen seen = outline_seen(outline, proxy);
    bool hardest = ANISOTROPIC || source.thin;
    bool hard = hardest || r.grazing || source.cut || source.size > NEAR || source_textured(source);
    if (!outline.elliptic && hard) seen.nodes = hardest ? 12u : 8u;
    // All around an ellipse the nodes are evenly spaced, as many as wanted.
    if (outline.elliptic && seen.azimuths.circle && hardest) seen.nodes = 24u;
    return outline_quadrature(r, source, outline, seen, proxy, lobe, hard ? 4u : 2u);
}

// One convex piece of the light.
void over_outline(inout Estimate sum, Receiver r, Source source, Outline outline, vec3 share) {
    for (uint lobe = 0u; lobe < LOBES; ++lobe) {
        if (!bsdf_has(lobe)) continue;
        Proxy proxy = receiver_proxy(r, lobe);
        if (share[lobe] > 0.0 && !(lambert() && lobe == LOBE_DIFFUSE && !source_textured(source))) {
            vec3 value = lobe_by_quadrature(r, source, outline, proxy, lobe);
            sum.lobes[lobe] += share[lobe] * source.light.radiance * value;
        }
        if (SHADOWS) pick_over_outline(sum.picks[lobe], r, source, outline, proxy, lobe);
    }
}

void by_cubature(inout Estimate sum, Receiver r, Source source, vec3 share) {
    bool coarse = source.size < POINT * r.narrowest && !source_textured(source);
    uint first = coarse ? source.light.coarse_first : source.light.fine_first;
    uint count = coarse ? source.light.coarse_count : source.light.fine_count;
    for (uint i = first; i < first + count; ++i) {
        vec3 position;
        vec3 radiance;
        float area;
        area_point(i, position, area, radiance);
        vec3 p = source_point(r.surface, position);
        if (LINES && source.light.kind == AREA_LINE) area *= line_front(source, p);
        float d2 = max(dot(p, p), TINY);
        vec3 wi = p * inversesqrt(d2);
        float projected = area * source_projection(source, wi) / d2;
        vec3 weight = projected * (TEXTURED_LIGHTS ? radiance : source.light.radiance);
        for (uint lobe = 0u; lobe < LOBES; ++lobe) {
            if (bsdf_has(lobe)) sum.lobes[lobe] += share[lobe] * weight * bsdf_eval_lobe_cos(r.surface.bsdf, wi, lobe);
        }
    }
}

void over_polygon(inout Estimate sum, Receiver r, Source source, vec3 share) {
    uint end = source.light.piece_first + source.light.piece_count;
    vec3 first = vec3(0.0);
    bool begins = true;
    Cone cone;
    for (uint i = source.light.piece_first; i < end; ++i) {
        vec4 vertex = area_vertex(i);
        vec3 a = source_point(r.surface, vertex.xyz);
        if (begins) {
            first = a;
            cone = cone_begin();
        }
        // A vertex with w = 1 is its piece's last.
        begins = vertex.w != 0.0;
        cone_edge(cone, a, begins ? first : source_point(r.surface, area_vertex(i + 1u).xyz));
        if (begins && cone.count > 2u) {
            cone_close(cone, source.front ? -1.0 : 1.0);
            over_outline(sum, r, source, outline_polygon(cone), share);
        }
    }
}

void over_strip(inout Estimate sum, Receiver r, Source source, vec3 share) {
    Strip strip = strip_of_line(source.center, source.u, source.light.radius);
    if (!strip.seen) return;
    // Not a select: of vectors by a specialisation constant spirv-opt takes the default's.
    uvec2 nodes = uvec2(4u, 8u);
    if (ANISOTROPIC) nodes = uvec2(8u, 12u);
    for (uint lobe = 0u; lobe < LOBES; ++lobe) {
        if (!bsdf_has(lobe)) continue;
        Proxy proxy = receiver_proxy(r, lobe);
        if (share[lobe] > 0.0 && !(lambert() && lobe == LOBE_DIFFUSE)) {
            sum.lobes[lobe] += share[lobe] * source.light.radiance * strip_quadrature(r, strip, proxy, lobe, nodes);
        }
        if (SHADOWS) pick_over_strip(sum.picks[lobe], r, strip, proxy, lobe);
    }
}

void over_shape(inout Estimate sum, Receiver r, Source source, vec3 share) {
    if (LINES && source.light.kind == AREA_LINE) {
        over_strip(sum, r, source, share);
    } else if (ELLIPSES && source.light.kind == AREA_ELLIPSE) {
        over_outline(sum, r, source, outline_ellipse(source.center, source.u, source.v), share);
    } else if (POLYGONS) {
        over_polygon(sum, r, source, share);
    }
}

// Takes over from the quadrature where the closed form is exact enough, and returns what is left to it.
vec3 by_closed_form(inout Estimate sum, Receiver r, Source source, vec3 share) {
    if (source_textured(source)) return share;
    if (lambert() && share.x > 0.0) {
        vec3 albedo = PI * bsdf_eval_lobe_cos(r.surface.bsdf, vec3(0.0, 0.0, 1.0), LOBE_DIFFUSE);
        float form_factor = source_form_factor(source, r.surface, mat3(1.0));
        sum.lobes[LOBE_DIFFUSE] += (share.x * form_factor) * source.light.radiance * albedo;
    }
    if (CLOSED_FORM && share.y > 0.0) {
        float form_factor = source_form_factor(source, r.surface, r.specular.proxy.q_from_local);
        // The fit errs by at most its total variation, of a whole that is 1.
        if (r.variation <= frame.light_error * form_factor) {
            sum.lobes[LOBE_SPECULAR] += (share.y * form_factor) * source.light.radiance * r.mass;
            share.y = 0.0;
        }
    }
    return share;
}

// How much of each lobe points of the light's surface cannot give; 0 of a lobe that the model has not.
vec3 beyond_points(Receiver r, Source source) {
    float size = source.size;
    // Points count the part above the horizon in sixteenths; the outline is cut there.
    if (source.cut) size *= CUT;
    if (LINES && source.light.kind == AREA_LINE) size *= THIN;
    vec3 share = vec3(0.0);
    if (bsdf_has(LOBE_DIFFUSE)) share.x = smoothstep(SMALL, LARGE, size / r.diffuse.width);
    if (bsdf_has(LOBE_SPECULAR)) share.y = smoothstep(SMALL, LARGE, size / r.specular.width);
    if (bsdf_has(LOBE_COAT)) share.z = smoothstep(SMALL, LARGE, size / r.coat.width);
    return share;
}

Estimate estimate_begin(uint index) {
    Estimate sum;
    for (uint lobe = 0u; lobe < LOBES; ++lobe) {
        sum.lobes[lobe] = vec3(0.0);
        if (SHADOWS) sum.picks[lobe] = pick_begin(index, lobe);
    }
    return sum;
}

vec3 estimate_end(Estimate sum, Receiver r, Source source) {
    vec3 reflected = vec3(0.0);
    for (uint lobe = 0u; lobe < LOBES; ++lobe) {
        if (!bsdf_has(lobe)) continue;
        reflected += sum.lobes[lobe] * (SHADOWS ? pick_visibility(sum.picks[lobe], r, source) : 1.0);
    }
    return reflected;
}

// Radiance towards the viewer from one area light.
vec3 area_reflected(Receiver r, uint index) {
    Source source = source_of(area_light(index), r.surface);
    if (!source_shines(source)) return vec3(0.0);
    vec3 share = beyond_points(r, source);
    Estimate sum = estimate_begin(index);
    if (any(lessThan(share, vec3(1.0)))) by_cubature(sum, r, source, 1.0 - share);
    share = by_closed_form(sum, r, source, share);
    if (SHADOWS || any(greaterThan(share, vec3(0.0)))) over_shape(sum, r, source, share);
    return estimate_end(sum, r, source);
}

// The same of a light that is small against all lobes, and whether it is.
bool small_reflected(inout vec3 sum, Receiver r, uint index) {
    Source source = source_of(area_light(index), r.surface);
    if (!source_shines(source)) return true;
    if (any(greaterThan(beyond_points(r, source), vec3(0.0)))) return false;
    Estimate points = estimate_begin(index);
    by_cubature(points, r, source, vec3(1.0));
    sum += estimate_end(points, r, source);
    return true;
}

#endif
