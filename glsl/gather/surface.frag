// What gathering has to know of a pixel's surface.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "bind/fragment.glsl"
#include "lib/light.glsl"
#include "bind/plane.glsl"
#include "bind/surface.glsl"
#include "gather/words.glsl"

layout(location = 0) out uvec4 words_a;
layout(location = 1) out uvec4 words_b;
layout(location = 2) out uvec4 words_c;

void main() {
    vec3 wo = view_direction();
    PackedBsdf bsdf = bsdf_pack(surface_parameters(), MODEL);
    SurfaceWords words = pack_surface(bsdf, shading_frame(wo), plane_normal(surface_position(), wo));
    words_a = words.a;
    words_b = words.b;
    words_c = words.c;
}
