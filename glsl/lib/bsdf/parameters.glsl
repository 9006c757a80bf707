// The material of one pixel, as the scene file names it. A model reads its own fields only.
#ifndef LIB_BSDF_PARAMETERS_GLSL
#define LIB_BSDF_PARAMETERS_GLSL

#ifndef IS_MODEL
#define IS_MODEL(model) (MODEL == (model))
#endif

struct BsdfParameters {
    vec3 color;            // matte: color; plastic, substrate: diffuse; metal: eta; principled: base_color
    vec3 specular;         // plastic, substrate: specular; metal: k
    float alpha_x;         // Trowbridge–Reitz alpha along the tangent, ≥ 1e-3; the only one read unless ANISOTROPIC
    float alpha_y;         // and along the bitangent
    float sigma;           // matte: standard deviation of the facets' slope angle, degrees
    float eta;             // plastic, principled: index of refraction relative to air
    float metallic;        // principled, from here on; all in [0, 1]
    float roughness;       // of diffuse and subsurface; the caller derives alpha_x and alpha_y from it
    float specular_tint;
    float sheen;
    float sheen_tint;
    float clearcoat;
    float clearcoat_gloss;
    float subsurface;
};

// What nobody reads.
const BsdfParameters NO_BSDF =
    BsdfParameters(vec3(0.0), vec3(0.0), 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

// 1 where the viewer is on the normal's side, else 0: multiplied into every lobe at setup, so the loop need not ask.
float faces_viewer(vec3 wo) { return wo.z > 0.0 ? 1.0 : 0.0; }

#endif
