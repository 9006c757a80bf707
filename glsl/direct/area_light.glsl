// What an area light adds to the light of a surface: the exact BSDF at points of cubature.
#ifndef DIRECT_AREA_LIGHT_GLSL
#define DIRECT_AREA_LIGHT_GLSL

layout(constant_id = 32) const bool POLYGONS = true;
layout(constant_id = 33) const bool ELLIPSES = true;
layout(constant_id = 34) const bool LINES = true;
layout(constant_id = 35) const bool TEXTURED_LIGHTS = true;
layout(constant_id = 36) const bool TWO_SIDED_LIGHTS = true;

// Area that a point sends light from, as seen along wi, per unit of its weight.
float area_facing(AreaLight light, vec3 wi) {
    float facing = -dot(light.normal, wi);
    facing = TWO_SIDED_LIGHTS && light.two_sided ? abs(facing) : max(facing, 0.0);
    if (!LINES || ((POLYGONS || ELLIPSES) && light.kind != AREA_LINE)) return facing;
    return 2.0 * light.radius * length(cross(wi, normalize(light.u)));
}

vec3 area_at_point(Surface s, AreaLight light, uint point) {
    vec3 position;
    float weight;
    vec3 radiance;
    area_point(point, position, weight, radiance);
    vec3 to_light = position - s.position;
    float d2 = dot(to_light, to_light);
    vec3 wi = to_light * inversesqrt(max(d2, 1e-30));
    float projected = weight * area_facing(light, wi) / max(d2, 1e-12);
    return bsdf_eval_cos(s.bsdf, wi * s.world_from_local) * projected * (TEXTURED_LIGHTS ? radiance : light.radiance);
}

// Radiance towards the viewer from one area light.
vec3 area_reflected(Surface s, AreaLight light) {
    vec3 sum = vec3(0.0);
    uint end = light.fine_first + light.fine_count;
    for (uint point = light.fine_first; point < end; ++point) sum += area_at_point(s, light, point);
    return sum;
}

// The same where the light is at least AREA_FAR times its extent away. A diffuse lobe varies so little over it that
// coarse points err by 1e-6.
vec3 area_reflected_far(Surface s, AreaLight light) {
    if (MODEL != MODEL_MATTE) return area_reflected(s, light);
    vec3 sum = vec3(0.0);
    uint end = light.coarse_first + light.coarse_count;
    for (uint point = light.coarse_first; point < end; ++point) sum += area_at_point(s, light, point);
    return sum;
}

#endif
