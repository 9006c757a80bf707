// How polygons, lines and frames of transformed cosines are usually written, after Heitz et al. 2016 and Heitz and
// Hill 2017, by the same steps as the shaders that they published.
#ifndef PROBE_HARD_AREA_USUAL_GLSL
#define PROBE_HARD_AREA_USUAL_GLSL

#include "probe/hard_area/shapes.glsl"

const uint CLIPPED_VERTICES = 9u;

// An angle over its sine that is 1 up to .001, and where acos has no number.
float usual_edge(vec3 u, vec3 v) {
    float angle = acos(dot(u, v));
    return cross(u, v).z * (angle > 0.001 ? angle / sin(angle) : 1.0);
}

// Directions of the vertices above the horizon, and where edges cross it; then a sum over unit vectors.
float usual_polygon(Ring ring) {
    vec3 above[CLIPPED_VERTICES];
    uint count = 0u;
    for (uint i = 0u; i < ring.count; ++i) {
        vec3 a = ring.vertices[i], b = ring.vertices[i + 1u < ring.count ? i + 1u : 0u];
        if (a.z >= 0.0) above[count++] = normalize(a);
        if ((a.z >= 0.0) != (b.z >= 0.0)) above[count++] = normalize(abs(b.z) * a + abs(a.z) * b);
    }
    float sum = 0.0;
    for (uint i = 0u; i < count; ++i) {
        sum += usual_edge(above[i], above[i + 1u < count ? i + 1u : 0u]);
    }
    return -0.5 * INV_PI * sum;
}

float usual_hole(HardProbeRow r) {
    return abs(usual_polygon(parallelogram(r, 1.0)) - usual_polygon(parallelogram(r, r.d.x)));
}

// A line without width, per radius, cut at the horizon: antiderivatives at its ends.
float usual_line(HardProbeRow r) {
    vec3 a = r.a.xyz, b = r.b.xyz;
    if (a.z <= 0.0 && b.z <= 0.0) return 0.0;
    if (a.z < 0.0) a = (a * b.z - b * a.z) / (b.z - a.z);
    if (b.z < 0.0) b = (b * a.z - a * b.z) / (a.z - b.z);
    vec3 along = normalize(b - a);
    vec2 l = vec2(dot(a, along), dot(b, along));
    vec3 foot = a - l.x * along;
    float d = length(foot);
    vec2 across = l / (d * (d * d + l * l)) + atan(l / d) / (d * d);
    vec2 lengthwise = l * l / (d * (d * d + l * l));
    return INV_PI * r.c.x * ((across.y - across.x) * foot.z + (lengthwise.y - lengthwise.x) * along.z);
}

// The same numbers as those that ship; the frame by the cross product of normal and view.
mat3 usual_map(HardProbeRow r) {
    vec3 y = normalize(cross(vec3(0.0, 0.0, 1.0), r.a.xyz));
    vec3 z = vec3(-r.a.xy, r.a.z);
    vec4 shape = vec4(r.b.x, r.c.x * r.b.yzw);
    return mat3(shape.x, 0.0, shape.z, 0.0, 1.0, 0.0, shape.y, 0.0, shape.w) * transpose(mat3(cross(y, z), y, z));
}

float usual_incidence(HardProbeRow r) {
    vec3 wo = r.a.xyz, n = r.b.xyz;
    return dot(wo, normalize(wo - n * dot(wo, n)));
}

#endif
