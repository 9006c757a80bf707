// An area light as the shaded point has it: in its local coordinates.
#ifndef DIRECT_SOURCE_GLSL
#define DIRECT_SOURCE_GLSL

#include "bind/area_lights.glsl"

layout(constant_id = 32) const bool POLYGONS = true;
layout(constant_id = 33) const bool ELLIPSES = true;
layout(constant_id = 34) const bool LINES = true;
layout(constant_id = 35) const bool TEXTURED_LIGHTS = true;
layout(constant_id = 36) const bool TWO_SIDED_LIGHTS = true;

struct Source {
    AreaLight light;
    vec3 center;  // a line's first end
    vec3 u;       // half axes; a line's whole axis
    vec3 v;
    vec3 normal;
    bool front;
    float size;   // radius over distance
    bool thin;    // seen at a grazing angle
    bool lit;     // some of it may be above the horizon
    bool cut;     // some of it may be below
};

vec3 source_point(Surface surface, vec3 world) { return (world - surface.position) * surface.world_from_local; }

Source source_of(AreaLight light, Surface surface) {
    Source source;
    source.light = light;
    source.center = source_point(surface, light.center);
    source.u = light.u * surface.world_from_local;
    source.v = light.v * surface.world_from_local;
    source.normal = light.normal * surface.world_from_local;
    bool line = LINES && light.kind == AREA_LINE;
    vec3 middle = source_point(surface, area_middle(light));
    source.front = line || dot(source.normal, source.center) < 0.0;
    source.size = light.extent * inversesqrt(max(dot(middle, middle), TINY));
    source.thin = !line && abs(dot(source.normal, source.center)) < 0.2 * sqrt(dot(source.center, source.center));
    source.lit = middle.z > -light.extent;
    source.cut = middle.z < light.extent;
    return source;
}

bool source_shines(Source source) {
    return source.lit && (source.front || (TWO_SIDED_LIGHTS && source.light.two_sided));
}

// Moves a point of a line's axis to the middle of what is seen of the cylinder there, and returns how wide that is over
// the diameter. Right to the first order of the radius over the distance.
float line_front(Source source, inout vec3 p) {
    vec3 across = p - source.u * (dot(p, source.u) / max(dot(source.u, source.u), TINY));
    float ratio = source.light.radius * inversesqrt(max(dot(across, across), TINY));
    float shift = 0.25 * PI * min(ratio, 1.0);
    p -= shift * across;
    // From inside there is nothing to see.
    return ratio < 1.0 ? 1.0 - shift : 0.0;
}

bool source_textured(Source source) { return TEXTURED_LIGHTS && source.light.textured; }

// Area as seen from direction wi, per area; of a line, per length.
float source_projection(Source source, vec3 wi) {
    if (LINES && source.light.kind == AREA_LINE) {
        vec3 across = cross(wi, source.u);
        return 2.0 * source.light.radius * sqrt(dot(across, across) / max(dot(source.u, source.u), TINY));
    }
    return abs(dot(source.normal, wi));
}

// Distance at which a ray along wi meets the light; a line's, its axis less the radius.
float source_distance(Source source, vec3 wi) {
    if (LINES && source.light.kind == AREA_LINE) {
        float along2 = max(dot(source.u, source.u), TINY);
        vec3 across = wi - source.u * (dot(wi, source.u) / along2);
        float t = dot(source.center, across) / max(dot(across, across), TINY);
        return t - source.light.radius * inversesqrt(max(dot(across, across), TINY));
    }
    float cosine = abs(dot(source.normal, wi));
    return abs(dot(source.normal, source.center)) / max(cosine, 1e-6);
}

// Texture where direction wi meets the light's plane, filtered over a solid angle.
vec3 source_texture(Source source, vec3 wi, float solid_angle) {
    float cosine = max(abs(dot(source.normal, wi)), 1e-6);
    float distance = source_distance(source, wi);
    vec3 p = distance * wi - source.center;
    vec3 across_v = cross(source.v, source.normal);
    vec3 across_u = cross(source.u, source.normal);
    float span = dot(source.u, across_v);  // |u × v|, signed
    vec3 st = vec3(dot(p, across_v) / span, -dot(p, across_u) / span, 1.0);
    AreaLight light = source.light;
    vec2 uv = vec2(dot(light.uv_s, st), dot(light.uv_t, st));
    // Solid angle to area, to area in (s, t), to texels.
    float area = solid_angle * sqr(distance) / (cosine * max(abs(span), TINY));
    float stretch = abs(light.uv_s.x * light.uv_t.y - light.uv_s.y * light.uv_t.x);
    float texels = area * stretch * float(light.width * light.height);
    return area_texel(light, uv, 0.5 * log2(max(texels, 1.0)));
}

#endif
