// What an area light adds to the light of a surface: the exact BSDF at points of cubature.
#ifndef DIRECT_AREA_LIGHT_GLSL
#define DIRECT_AREA_LIGHT_GLSL

layout(constant_id = 32) const bool POLYGONS = true;
layout(constant_id = 33) const bool ELLIPSES = true;
layout(constant_id = 34) const bool LINES = true;
layout(constant_id = 35) const bool TEXTURED_LIGHTS = true;
layout(constant_id = 36) const bool TWO_SIDED_LIGHTS = true;

bool is_line(AreaLight light) { return LINES && (!(POLYGONS || ELLIPSES) || light.kind == AREA_LINE); }

// Moves a point on a line's axis to the middle of what is seen of the cylinder there, and returns the width of that. Right
// to the first order of the radius over the distance.
float line_width(AreaLight light, inout vec3 to_light) {
    vec3 axis = normalize(light.u);
    vec3 across = to_light - axis * dot(to_light, axis);
    float ratio = light.radius * inversesqrt(max(dot(across, across), 1e-30));
    to_light -= 0.25 * PI * min(ratio, 1.0) * across;
    // From inside there is nothing to see.
    return ratio < 1.0 ? 2.0 * light.radius * (1.0 - 0.25 * PI * ratio) : 0.0;
}

vec3 area_at_point(Surface s, AreaLight light, uint point) {
    vec3 position;
    float weight;
    vec3 radiance;
    area_point(point, position, weight, radiance);
    vec3 to_light = position - s.position;
    bool line = is_line(light);
    float width = line ? line_width(light, to_light) : 0.0;
    float d2 = dot(to_light, to_light);
    vec3 wi = to_light * inversesqrt(max(d2, 1e-30));
    // Area seen along wi over the point's weight.
    float facing = -dot(light.normal, wi);
    facing = TWO_SIDED_LIGHTS && light.two_sided ? abs(facing) : max(facing, 0.0);
    if (line) facing = width * length(cross(wi, normalize(light.u)));
    vec3 lobe = bsdf_eval_cos(s.bsdf, wi * s.world_from_local) * (weight * facing / max(d2, 1e-12));
    return lobe * (TEXTURED_LIGHTS ? radiance : light.radiance);
}

vec3 area_summed(Surface s, AreaLight light, uint first, uint count) {
    vec3 sum = vec3(0.0);
    for (uint point = first; point < first + count; ++point) sum += area_at_point(s, light, point);
    return sum;
}

// Whether a diffuse lobe varies so little over a light that coarse points do.
bool area_far(Surface s, AreaLight light) {
    vec3 to_light = area_middle(light) - s.position;
    float least = float(AREA_FAR) * light.extent;
    return MODEL == MODEL_MATTE && dot(to_light, to_light) > least * least;
}

// Radiance towards the viewer from one area light.
vec3 area_reflected(Surface s, AreaLight light) {
    bool far = area_far(s, light);
    uint first = far ? light.coarse_first : light.fine_first;
    return area_summed(s, light, first, far ? light.coarse_count : light.fine_count);
}

// The same where the light is known to be at least AREA_FAR times its extent away, with the same result.
vec3 area_reflected_far(Surface s, AreaLight light) {
    if (MODEL != MODEL_MATTE) return area_summed(s, light, light.fine_first, light.fine_count);
    return area_summed(s, light, light.coarse_first, light.coarse_count);
}

#endif
