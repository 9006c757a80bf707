// What the material is at a pixel.
#ifndef AOV_MATERIAL_GLSL
#define AOV_MATERIAL_GLSL

#include "bind/ltc.glsl"
#include "direct/albedo.glsl"

vec3 material_color(BsdfParameters p) {
    if (MODEL == MODEL_METAL) return fresnel_conductor(conductor_setup(p.color, p.specular), 1.0);
    return p.color;
}

vec3 material_roughness(BsdfParameters p) {
    if (!bsdf_has(LOBE_SPECULAR)) return vec3(1.0);
    float y = ANISOTROPIC ? p.alpha_y : p.alpha_x;
    return vec3(sqrt(p.alpha_x * y), p.alpha_x, y);
}

// As direct/receiver.glsl has it.
float ltc_bound(BsdfParameters p, float cos_o) {
    if (!bsdf_has(LOBE_SPECULAR) || frame.area_lights == 0u) return 0.0;
    vec4 moments = ltc_at(LTC_SPECULAR, sqrt(material_roughness(p).x), max(cos_o, 0.01)).moments;
    return min(moments.w + specular_albedo(p, moments).unfitted, 1.0);
}

#endif
