// What ships in lib/area/, as glsl/direct/closed_form.glsl calls it.
#ifndef PROBE_HARD_AREA_SHIPPED_GLSL
#define PROBE_HARD_AREA_SHIPPED_GLSL

#include "lib/area/ellipse_form_factor.glsl"
#include "lib/area/form_factor.glsl"
#include "lib/area/line.glsl"
#include "lib/area/proxy.glsl"
#include "lib/frame.glsl"
#include "probe/hard_area/shapes.glsl"

void shipped_ring(inout FormFactor f, Ring ring, vec3 base) {
    for (uint i = 0u; i < ring.count; ++i) {
        form_factor_edge(f, base + ring.vertices[i], base + ring.vertices[i + 1u < ring.count ? i + 1u : 0u]);
    }
    form_factor_close_ring(f);
}

// Relative to the middle of its vertices where it is small.
float shipped_polygon(Ring ring) {
    vec3 center = vec3(0.0);
    for (uint i = 0u; i < ring.count; ++i) center += ring.vertices[i] / float(ring.count);
    float radius = 0.0;
    for (uint i = 0u; i < ring.count; ++i) {
        ring.vertices[i] -= center;
        radius = max(radius, length(ring.vertices[i]));
    }
    vec3 anchor = form_factor_anchor(center, radius);
    FormFactor f = form_factor_begin(anchor);
    shipped_ring(f, ring, center - anchor);
    return form_factor_end(f);
}

// One outline of two rings, the inner one the other way.
float shipped_hole(HardProbeRow r) {
    vec3 u = r.b.xyz, v = r.c.xyz;
    vec3 anchor = form_factor_anchor(r.a.xyz, sqrt(dot(u, u) + dot(v, v)));
    FormFactor f = form_factor_begin(anchor);
    shipped_ring(f, ring_of(-u - v, u - v, u + v, v - u), r.a.xyz - anchor);
    u *= r.d.x;
    v *= r.d.x;
    shipped_ring(f, ring_of(v - u, u + v, u - v, -u - v), r.a.xyz - anchor);
    return abs(form_factor_end(f));
}

float shipped_line(HardProbeRow r) {
    Line line = line_setup(r.a.xyz, r.b.xyz, r.c.x);
    FormFactor f = form_factor_begin();
    for (uint i = 0u; i < LINE_VERTICES; ++i) {
        form_factor_edge(f, line_vertex(line, i), line_vertex(line, (i + 1u) % LINE_VERTICES));
    }
    form_factor_close_ring(f);
    return line.visible ? abs(form_factor_end(f)) : 0.0;
}

// A view, a table's four numbers, and twice alpha.
mat3 shipped_map(HardProbeRow r) { return proxy_of_microfacets(r.b, r.c.x, r.a.xyz).q_from_local; }

// A view and a normal.
float shipped_incidence(HardProbeRow r) {
    vec3 n = r.b.xyz, t = any_tangent(n);
    vec3 wo = r.a.xyz * mat3(t, cross(n, t), n);
    vec3 y = mirror_frame(wo)[1];
    return dot(wo.xy, vec2(y.y, -y.x));
}

#endif
