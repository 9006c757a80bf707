// The surface of a pixel, as gather/surface.frag left it.
#ifndef GATHER_VISIBLE_GLSL
#define GATHER_VISIBLE_GLSL

#include "gather/words.glsl"

layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_gather, binding = GATHER_WORDS_A) uniform utexture2D words_a;
layout(set = SET_gather, binding = GATHER_WORDS_B) uniform utexture2D words_b;
layout(set = SET_gather, binding = GATHER_WORDS_C) uniform utexture2D words_c;
layout(constant_id = 9) const bool PERSPECTIVE = true;

// What of it all pixels of a tile have to know.
struct SeenPlace {
    vec3 position;
    vec3 normal;
    bool exists;
};

vec3 seen_position(ivec2 pixel) {
    float z = view_depth(frame, texelFetch(depth_texture, pixel, 0).r);
    return world_position(frame, vec2(pixel) + 0.5, z);
}

SeenPlace place_at(ivec2 pixel) {
    bool exists = texelFetch(words_a, pixel, 0).x != 0u;
    return SeenPlace(seen_position(pixel), unpack_unit(texelFetch(words_c, pixel, 0).z), exists);
}

Vertex visible_at(ivec2 pixel, float bound) {
    SurfaceWords words = SurfaceWords(
            texelFetch(words_a, pixel, 0), texelFetch(words_b, pixel, 0), texelFetch(words_c, pixel, 0));
    PackedBsdf bsdf = bsdf_words(words);
    surface_model = bsdf_unpack_model(bsdf);
    vec3 position = seen_position(pixel);
    vec3 wo = PERSPECTIVE ? normalize(frame.eye - position) : -frame.forward;
    vec3 geometric = unpack_unit(words.c.w);
    vec3 origin = offset_origin(position, geometric, distance(position, frame.eye));
    return vertex_at(position, origin, geometric, frame_words(words), bsdf_unpack(bsdf), wo, bound);
}

#endif
