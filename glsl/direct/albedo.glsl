// Albedo of a specular lobe from the integrals of its table, with the material's own Fresnel curve.
#ifndef DIRECT_ALBEDO_GLSL
#define DIRECT_ALBEDO_GLSL

#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/parameters.glsl"
#include "lib/bsdf/principled.glsl"

struct Albedo {
    vec3 mass;
    // Share of the lobe whose shape is not the fitted one: by so much more its transformed cosine may be off.
    float unfitted;
};

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

// Schlick's curve over the integrals of 1 and (1 − wo·h)⁵, for a table that was fitted at reflectance `fitted`.
Albedo schlick_albedo(vec3 f0, float fitted, vec4 moments) {
    vec3 mass = f0 * moments.x + (1.0 - f0) * moments.y;
    float fitted_mass = fitted * moments.x + (1.0 - fitted) * moments.y;
    // f0 + (1 − f0) s is a multiple of the fitted curve and a rest of one sign, in 1 or in s.
    vec3 of_fitted = min(f0 / fitted, (1.0 - f0) / max(1.0 - fitted, TINY));
    if (fitted == 1.0) of_fitted = f0;
    return Albedo(mass, largest(1.0 - of_fitted * fitted_mass / max(mass, vec3(TINY))));
}

// Lazányi's curve f0 + (1 − f0)(1 − c)⁵ + a c (1 − c)⁶, exact at c = 1, 1/7, and 0.
Albedo conductor_albedo(vec3 eta, vec3 k, vec4 moments) {
    Conductor metal = conductor_setup(eta, k);
    vec3 f0 = fresnel_conductor(metal, 1.0);
    const float c = 1.0 / 7.0;
    const float rest = 6.0 / 7.0;
    const float bump = c * rest * rest * rest * rest * rest * rest;
    vec3 a = (fresnel_conductor(metal, c * c) - f0 - (1.0 - f0) * pow5(rest)) / bump;
    vec3 others = (1.0 - f0) * moments.y + a * moments.z;
    vec3 mass = max(f0 * moments.x + others, vec3(0.0));
    vec3 unfitted = ((1.0 - f0) * moments.y + abs(a) * moments.z) / max(mass, vec3(TINY));
    return Albedo(mass, largest(unfitted));
}

Albedo specular_albedo(BsdfParameters p, vec4 moments) {
    if (MODEL == MODEL_METAL) return conductor_albedo(p.color, p.specular, moments);
    // Fitted at this one index.
    if (MODEL == MODEL_PLASTIC) return Albedo(p.specular * moments.x, abs(p.eta - 1.5) < 1e-3 ? 0.0 : 1.0);
    if (MODEL == MODEL_SUBSTRATE) return schlick_albedo(p.specular, 0.05, moments);
    return schlick_albedo(principled_f0(p), LTC_METALLIC ? 1.0 : 0.04, moments);
}

#endif
