// The closed form of linearly transformed cosines (Heitz et al. 2016): albedo times the form factor of the light in the
// lobe's own coordinates.
#ifndef PROBE_AREA_TIER_CLOSED_FORM_GLSL
#define PROBE_AREA_TIER_CLOSED_FORM_GLSL

// Lambert's lobe, for which the cosine is exact.
vec3 diffuse_closed_form(Receiver r, Source source) {
    if (!bsdf_has(LOBE_DIFFUSE)) return vec3(0.0);
    vec3 albedo = PI * bsdf_eval_lobe_cos(r.surface.bsdf, vec3(0.0, 0.0, 1.0), LOBE_DIFFUSE);
    return source_form_factor(source, r.surface, mat3(1.0)) * albedo * source.light.radiance;
}

vec3 closed_form(Receiver r, Source source) {
    vec3 specular = source_form_factor(source, r.surface, r.specular.proxy.q_from_local) * r.mass;
    return specular * source.light.radiance + diffuse_closed_form(r, source);
}

#endif
