// Nodes against the narrowest lobe of a surface: far from the mirror direction a lobe changes over angles about as wide as
// the way to it, near it over its own width, so a node has to be small against either.
#ifndef DIRECT_LOBE_GLSL
#define DIRECT_LOBE_GLSL

struct Lobe {
    vec3 mirror;  // world, unit
    float width2;  // squared, radians
};

// Whether the model has a lobe that may be narrower than a cosine; known when the pipeline is compiled.
bool lobe_is_narrow() { return MODEL != MODEL_MATTE; }

Lobe lobe_here(Surface s) {
    if (!lobe_is_narrow()) return Lobe(vec3(0.0), 1.0);
    BsdfParameters p = surface_parameters();
    float alpha = ANISOTROPIC ? min(p.alpha_x, p.alpha_y) : p.alpha_x;
    if (MODEL == MODEL_PRINCIPLED && LOBE_CLEARCOAT) alpha = min(alpha, lerp(0.1, 0.001, p.clearcoat_gloss));
    vec3 wo = view_direction();
    vec3 n = s.world_from_local[2];
    float cosine = dot(n, wo);
    // Half vectors turn by half as much as directions, and across the plane of incidence by less at grazing angles.
    float width = 2.0 * alpha * max(cosine, 0.1);
    return Lobe(2.0 * cosine * n - wo, width * width);
}

bool lobe_fits(Lobe lobe, vec3 offset, float d2, float radius) {
    if (!lobe_is_narrow()) return true;
    float inverse = inversesqrt(max(d2, TINY));
    float extent = radius * inverse;
    vec3 apart = offset * inverse - lobe.mirror;
    float least = max(sqrt(dot(apart, apart)) - extent, 0.0);
    return extent * extent <= frame.cut_lobe2 * (lobe.width2 + least * least);
}

#endif
