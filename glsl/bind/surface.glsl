// The shaded surface: its place and frame, the material's parameters and its BSDF in that frame. Both front ends shade by
// this file; what it asks of them, the including shader takes before this line from
//   bind/fragment.glsl   the surface under a fragment, or
//   bind/pixel.glsl      the surface of any pixel, from what the prepass noted of it.
#ifndef BIND_SURFACE_GLSL
#define BIND_SURFACE_GLSL

layout(constant_id = 0) const uint MODEL = MODEL_MATTE;
layout(constant_id = 1) const bool ANISOTROPIC = false;
layout(constant_id = 2) const bool SQUARED_ROUGHNESS = false;
layout(constant_id = 3) const bool ROUGH_MATTE = false;
layout(constant_id = 4) const bool LOBE_SHEEN = false;
layout(constant_id = 5) const bool LOBE_CLEARCOAT = false;
layout(constant_id = 6) const bool LOBE_SUBSURFACE = false;
layout(constant_id = 7) const bool LOBE_METALLIC = false;
layout(constant_id = 8) const bool TWO_SIDED = true;
layout(constant_id = 9) const bool PERSPECTIVE = true;

#include "lib/bsdf.glsl"
#include "lib/cluster.glsl"
#include "lib/frame.glsl"

struct Surface {
    vec3 position;  // world
    mat3 world_from_local;  // columns: tangent, bitangent, normal
    Bsdf bsdf;
};

// Tangent, bitangent, normal. A two-sided surface's interpolated normal is turned to the viewer by its own cosine,
// not by the triangle's facing: at the silhouette of a smooth mesh the two differ, and a normal turned away would
// leave a black rim. A normal map is applied on the front and turned with it. Round lobes look alike in any frame: for
// them the tangent is not fetched.
mat3 shading_frame(vec3 wo) {
    // Normals that cancel between vertices have no direction.
    vec3 n = dot(in_normal, in_normal) > 1e-20 ? normalize(in_normal) : vec3(0.0, 1.0, 0.0);
    float turn = TWO_SIDED && dot(n, wo) < 0.0 ? -1.0 : 1.0;
    if (!ANISOTROPIC && SLOT_NORMAL == NO_TEXTURE) {
        n *= turn;
        vec3 t = any_tangent(n);
        return mat3(t, cross(n, t), n);
    }
    vec3 t = tangent_to(n, in_tangent.xyz);
    if (SLOT_NORMAL != NO_TEXTURE) {
        n = mapped_normal(n, in_tangent, normal_texel(), turn, wo);
    } else {
        n *= turn;
    }
    t = tangent_to(n, t);
    return mat3(t, cross(n, t), n);
}

// The number that the material gives: perceptual roughness, or alpha.
vec2 roughness_and_alpha() {
    float value = parameter(2u, SLOT_ROUGHNESS).x;
    return SQUARED_ROUGHNESS ? vec2(value, value * value) : vec2(sqrt(max(value, 0.0)), value);
}

// As `reference::shading` has it: stretched by the aspect, at least 1e-3.
vec2 alphas(float alpha) {
    float aspect = 1.0;
    if (ANISOTROPIC) {
        aspect = parameter(3u, SLOT_ASPECT).x;
        if (SLOT_ASPECT != NO_TEXTURE) aspect = sqrt(max(1.0 - 0.9 * aspect, 1e-4));
        // A tangent of length 0 has no direction to stretch along.
        if (dot(in_tangent.xyz, in_tangent.xyz) == 0.0) aspect = 1.0;
    }
    return max(vec2(alpha / aspect, alpha * aspect), vec2(1e-3));
}

BsdfParameters surface_parameters() {
    BsdfParameters p;
    p.color = parameter(0u, SLOT_COLOR);
    p.specular = parameter(1u, SLOT_SPECULAR);
    vec2 rough = roughness_and_alpha();
    p.roughness = rough.x;
    vec2 a = alphas(rough.y);
    p.alpha_x = a.x;
    p.alpha_y = a.y;
    p.sigma = parameter(4u, SLOT_SIGMA).x;
    p.eta = parameter(5u, SLOT_ETA).x;
    p.metallic = parameter(6u, SLOT_METALLIC).x;
    p.specular_tint = parameter(7u, SLOT_SPECULAR_TINT).x;
    p.sheen = parameter(8u, SLOT_SHEEN).x;
    p.sheen_tint = parameter(9u, SLOT_SHEEN_TINT).x;
    p.clearcoat = parameter(10u, SLOT_CLEARCOAT).x;
    p.clearcoat_gloss = parameter(11u, SLOT_CLEARCOAT_GLOSS).x;
    p.subsurface = parameter(12u, SLOT_SUBSURFACE).x;
    return p;
}

// World position of the surface at the pixel's centre, from the depth that the fragment has: the cluster pass bounds the
// same points. A device that snaps vertices to few subpixel positions moves interpolated ones along the surface.
vec3 surface_position() {
    vec3 window = window_position();
    return world_position(frame, window.xy, view_depth(frame, window.z));
}

// Towards the viewer, world.
vec3 view_direction() { return PERSPECTIVE ? normalize(frame.eye - surface_position()) : -frame.forward; }

Surface surface_here() {
    Surface s;
    s.position = surface_position();
    vec3 wo = view_direction();
    s.world_from_local = shading_frame(wo);
    s.bsdf = bsdf_setup(surface_parameters(), wo * s.world_from_local);
    return s;
}

// Radiance towards the viewer from one point light, by its two texels.
vec3 reflected(Surface s, vec4 place, vec4 power) {
    vec3 to_light = place.xyz - s.position;
    float d2 = dot(to_light, to_light);
    // A light on the surface has no direction: wi = 0, which every BSDF answers with 0.
    vec3 wi = (to_light * inversesqrt(max(d2, 1e-30))) * s.world_from_local;
    return bsdf_eval_cos(s.bsdf, wi) * (power.rgb * falloff(d2, place.w, power.w));
}

vec3 reflected(Surface s, uint light) { return reflected(s, light_place(light), light_power(light)); }

#endif
