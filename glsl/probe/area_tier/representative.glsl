// The representative point of Karis 2013, «Real Shading in Unreal Engine 4»: specular light comes from the light's point
// nearest to the mirror direction, with alpha widened by the light's size to keep energy; diffuse from its middle.
#ifndef PROBE_AREA_TIER_REPRESENTATIVE_GLSL
#define PROBE_AREA_TIER_REPRESENTATIVE_GLSL

vec3 nearest_to_ray(Source source, vec3 ray) {
    if (LINES && source.light.kind == AREA_LINE) {
        float along = dot(ray, source.u);
        float least = dot(ray, source.center) * along - dot(source.center, source.u);
        return source.center + clamp(least / max(dot(source.u, source.u) - along * along, TINY), 0.0, 1.0) * source.u;
    }
    float facing = dot(source.normal, ray);
    float t = dot(source.normal, source.center) / (abs(facing) > 1e-6 ? facing : 1e-6);
    // A ray that leaves the plane behind: the point as far away as the light.
    vec3 p = (t > 0.0 ? t : sqrt(dot(source.center, source.center))) * ray - source.center;
    vec2 st = vec2(dot(p, source.u) / dot(source.u, source.u), dot(p, source.v) / dot(source.v, source.v));
    st = ELLIPSES && source.light.kind == AREA_ELLIPSE ? st / max(1.0, sqrt(dot(st, st))) : clamp(st, -1.0, 1.0);
    return source.center + st.x * source.u + st.y * source.v;
}

// Of a line its length: `source_projection` has the width.
float source_area(Source source) {
    if (LINES && source.light.kind == AREA_LINE) return sqrt(dot(source.u, source.u));
    vec3 area = cross(source.u, source.v);
    return (ELLIPSES && source.light.kind == AREA_ELLIPSE ? PI : 4.0) * sqrt(dot(area, area));
}

float widening(float alpha, float radius) { return alpha / min(alpha + radius * (1.0 / 3.0), 1.0); }

vec3 representative(Receiver r, Source source) {
    bool line = LINES && source.light.kind == AREA_LINE;
    vec3 middle = line ? source.center + 0.5 * source.u : source.center;
    float d2 = dot(middle, middle);
    vec3 towards = middle * inversesqrt(d2);
    float area = source_area(source);
    float power = area * source_projection(source, towards) / d2;
    float alpha = row.color_alpha.w;
    float energy;
    if (line) {
        energy = widening(alpha, 0.5 * area * inversesqrt(d2)) * sqr(widening(alpha, source.light.radius * inversesqrt(d2)));
    } else {
        energy = sqr(widening(alpha, sqrt(area * INV_PI / d2)));
    }
    vec3 p = nearest_to_ray(source, vec3(-row.wo.xy, row.wo.z));
    vec3 wi = p * inversesqrt(max(dot(p, p), TINY));
    vec3 sum = energy * bsdf_eval_lobe_cos(r.surface.bsdf, wi, LOBE_SPECULAR);
    if (bsdf_has(LOBE_DIFFUSE)) sum += bsdf_eval_lobe_cos(r.surface.bsdf, towards, LOBE_DIFFUSE);
    return power * sum * source.light.radiance;
}

#endif
