// The form factor of a whole light, of any shape, in the space of a linear map: Lambert's, or a transformed cosine's.
#ifndef DIRECT_CLOSED_FORM_GLSL
#define DIRECT_CLOSED_FORM_GLSL

#include "lib/area/ellipse_form_factor.glsl"
#include "lib/area/form_factor.glsl"
#include "lib/area/line.glsl"

float polygon_form_factor(AreaLight light, vec3 origin, mat3 q_from_world, vec3 anchor) {
    FormFactor sum = form_factor_begin(anchor);
    uint end = light.ring_first + light.ring_count;
    vec3 first = vec3(0.0);
    bool begins = true;
    for (uint i = light.ring_first; i < end; ++i) {
        vec4 vertex = area_vertex(i);
        vec3 a = q_from_world * (vertex.xyz - origin);
        if (begins) first = a;
        // A vertex with w = 1 is its ring's last. One call, not one for the closing edge too: lavapipe compiles each.
        begins = vertex.w != 0.0;
        vec3 b = begins ? first : q_from_world * (area_vertex(i + 1u).xyz - origin);
        form_factor_edge(sum, a, b);
        if (begins) form_factor_close_ring(sum);
    }
    return abs(form_factor_end(sum));
}

float line_form_factor(vec3 start, vec3 axis, float radius, mat3 q_from_local) {
    Line line = line_setup(start, start + axis, radius);
    if (!line.visible) return 0.0;
    FormFactor sum = form_factor_begin();
    vec3 a = q_from_local * line_vertex(line, LINE_VERTICES - 1u);
    for (uint i = 0u; i < LINE_VERTICES; ++i) {
        vec3 b = q_from_local * line_vertex(line, i);
        form_factor_edge(sum, a, b);
        a = b;
    }
    form_factor_close_ring(sum);
    return abs(form_factor_end(sum));
}

float source_form_factor(Source source, Surface surface, mat3 q_from_local) {
    AreaLight light = source.light;
    if (LINES && light.kind == AREA_LINE) return line_form_factor(source.center, source.u, light.radius, q_from_local);
    vec3 center = q_from_local * source.center;
    vec3 u = q_from_local * source.u;
    vec3 v = q_from_local * source.v;
    if (ELLIPSES && light.kind == AREA_ELLIPSE) return ellipse_form_factor(center, u, v);
    if (!POLYGONS) return 0.0;
    // A small light's vertices are taken relative to its center, in the world, where both have all their digits.
    vec3 anchor = form_factor_anchor(center, sqrt(dot(u, u) + dot(v, v)));
    bool anchored = dot(anchor, anchor) > 0.0;
    mat3 q_from_world = q_from_local * transpose(surface.world_from_local);
    return polygon_form_factor(light, anchored ? light.center : surface.position, q_from_world, anchor);
}

#endif
