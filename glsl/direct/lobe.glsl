// Nodes against the narrowest lobe of a surface: far from the mirror direction a lobe changes over angles about as wide as
// the way to it, near it over its own width, so a node has to be small against either.
#ifndef DIRECT_LOBE_GLSL
#define DIRECT_LOBE_GLSL

struct Lobe {
    vec3 mirror;  // world, unit
    float width2;  // squared, radians
    float strength;  // f cosθ at its peak, times width2
};

// Whether the model has a lobe that may be narrower than a cosine; known when the pipeline is compiled.
bool lobe_is_narrow() { return MODEL != MODEL_MATTE; }

// Fresnel's reflectance or more of it than there is.
float lobe_reflectance(BsdfParameters p, float cosine) {
    if (MODEL == MODEL_METAL) return 1.0;
    float normal = sqr((p.eta - 1.0) / (p.eta + 1.0));
    if (MODEL == MODEL_SUBSTRATE) normal = max(p.specular.r, max(p.specular.g, p.specular.b));
    if (MODEL == MODEL_PRINCIPLED && LOBE_METALLIC) normal = lerp(normal, 1.0, p.metallic);
    return lerp(normal, 1.0, pow5(1.0 - cosine));
}

Lobe lobe_here(Surface s) {
    if (!lobe_is_narrow()) return Lobe(vec3(0.0), 1.0, 0.0);
    BsdfParameters p = surface_parameters();
    float alpha = ANISOTROPIC ? min(p.alpha_x, p.alpha_y) : p.alpha_x;
    if (MODEL == MODEL_PRINCIPLED && LOBE_CLEARCOAT) alpha = min(alpha, lerp(0.1, 0.001, p.clearcoat_gloss));
    vec3 wo = view_direction();
    vec3 n = s.world_from_local[2];
    float cosine = dot(n, wo);
    // Half vectors turn by half as much as directions, and across the plane of incidence by less at grazing angles.
    float width = 2.0 * alpha * max(cosine, 0.1);
    float strength = INV_PI * lobe_reflectance(p, max(cosine, 0.0)) / max(cosine, 0.1);
    return Lobe(2.0 * cosine * n - wo, width * width, strength * width * width);
}

// Of the limit, what a lobe may make of a node that is large against it: such nodes err by one sign. Half of it
// changes next to nothing.
const float LOBE_SHARE = 0.125;

// True too for a node so weak, or so far from the mirror direction, that what the lobe makes of it is within the limit
// whatever its size: Trowbridge and Reitz's falls with the fourth power of the angle.
bool lobe_fits(Lobe lobe, MomentHead node, vec3 offset, float d2, float limit) {
    if (!lobe_is_narrow()) return true;
    float inverse2 = 1.0 / max(d2, TINY);
    float inverse = sqrt(inverse2);
    float extent = node.radius * inverse;
    vec3 apart = offset * inverse - lobe.mirror;
    float least = max(sqrt(dot(apart, apart)) - extent, 0.0);
    float scale2 = lobe.width2 + least * least;
    float part = extent * extent / scale2;
    float peak = lobe.strength / (scale2 * scale2);
    return part <= frame.cut_lobe2 || node.power * inverse2 * peak * part <= LOBE_SHARE * INV_PI * limit;
}

#endif
