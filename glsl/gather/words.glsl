// What gathering knows of a pixel's surface, in twelve words: ten of the BSDF, the last of which has room for the tangent's
// angle; the normal; the triangle's normal on the viewer's side. Without a surface all are 0, which no alpha is.
#ifndef GATHER_WORDS_GLSL
#define GATHER_WORDS_GLSL

#include "lib/bsdf/packed.glsl"
#include "lib/frame.glsl"
#include "lib/octahedron.glsl"

struct SurfaceWords {
    uvec4 a;
    uvec4 b;
    uvec4 c;
};

// The tangent's angle from the one that any_tangent() has for the normal, in 65,536ths of a turn: ±5e-5.
uint pack_tangent(vec3 n, vec3 t) {
    vec3 x = any_tangent(n);
    float turns = atan(dot(t, cross(n, x)), dot(t, x)) * (0.5 * INV_PI);
    return uint(round((turns + 1.0) * 65536.0)) & 0xffffu;
}

vec3 unpack_tangent(vec3 n, uint angle) {
    vec3 x = any_tangent(n);
    float radians = float(angle) * (2.0 * PI / 65536.0);
    return cos(radians) * x + sin(radians) * cross(n, x);
}

SurfaceWords pack_surface(PackedBsdf bsdf, mat3 world_from_local, vec3 geometric) {
    uint normal = pack_unit(world_from_local[2]);
    uint tangent = pack_tangent(unpack_unit(normal), world_from_local[0]);
    return SurfaceWords(
            uvec4(bsdf.words[0], bsdf.words[1], bsdf.words[2], bsdf.words[3]),
            uvec4(bsdf.words[4], bsdf.words[5], bsdf.words[6], bsdf.words[7]),
            uvec4(bsdf.words[8], bsdf.words[9] | tangent << 16, normal, pack_unit(geometric)));
}

PackedBsdf bsdf_words(SurfaceWords s) {
    return PackedBsdf(
            uint[BSDF_WORDS](s.a.x, s.a.y, s.a.z, s.a.w, s.b.x, s.b.y, s.b.z, s.b.w, s.c.x, s.c.y & 0xffffu));
}

mat3 frame_words(SurfaceWords s) {
    vec3 n = unpack_unit(s.c.z);
    vec3 t = unpack_tangent(n, s.c.y >> 16);
    return mat3(t, cross(n, t), n);
}

#endif
