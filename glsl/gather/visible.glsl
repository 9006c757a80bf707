// The surface of a pixel, as gather/surface.frag left it.
#ifndef GATHER_VISIBLE_GLSL
#define GATHER_VISIBLE_GLSL

#include "gather/words.glsl"

layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_gather, binding = GATHER_WORDS_A) uniform utexture2D words_a;
layout(set = SET_gather, binding = GATHER_WORDS_B) uniform utexture2D words_b;
layout(set = SET_gather, binding = GATHER_WORDS_C) uniform utexture2D words_c;
layout(constant_id = 9) const bool PERSPECTIVE = true;

struct Visible {
    Vertex vertex;
    bool exists;
};

Visible visible_at(ivec2 pixel) {
    SurfaceWords words = SurfaceWords(
            texelFetch(words_a, pixel, 0), texelFetch(words_b, pixel, 0), texelFetch(words_c, pixel, 0));
    PackedBsdf bsdf = bsdf_words(words);
    surface_model = bsdf_unpack_model(bsdf);
    float z = view_depth(frame, texelFetch(depth_texture, pixel, 0).r);
    vec3 position = world_position(frame, vec2(pixel) + 0.5, z);
    vec3 wo = PERSPECTIVE ? normalize(frame.eye - position) : -frame.forward;
    vec3 geometric = unpack_unit(words.c.w);
    vec3 origin = offset_origin(position, geometric, max(greatest(abs(position)), distance(position, frame.eye)));
    Vertex vertex = vertex_at(position, origin, geometric, frame_words(words), bsdf_unpack(bsdf), wo);
    return Visible(vertex, words.a.x != 0u);
}

#endif
