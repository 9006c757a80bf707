// Unit vectors in a word: octahedral maps (Cigolle et al. 2014).
#ifndef LIB_OCTAHEDRON_GLSL
#define LIB_OCTAHEDRON_GLSL

#include "lib/math.glsl"

vec3 from_octahedron(vec2 e) {
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float below = max(-v.z, 0.0);
    v.x += v.x >= 0.0 ? -below : below;
    v.y += v.y >= 0.0 ? -below : below;
    return normalize(v);
}

vec2 to_octahedron(vec3 v) {
    v /= abs(v.x) + abs(v.y) + abs(v.z);
    vec2 folded = (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
    return v.z >= 0.0 ? v.xy : folded;
}

// Off by 5e-5 at most.
uint pack_unit(vec3 v) { return packSnorm2x16(to_octahedron(v)); }
vec3 unpack_unit(uint word) { return from_octahedron(unpackSnorm2x16(word)); }

// Directions within an angle of an axis.
struct Cone {
    vec3 axis;
    float cosine;  // of the half angle; -1: the whole sphere
};

// See `VirtualPair::left_cone`.
Cone unpack_cone(uint word) {
    vec2 axis = vec2(bitfieldExtract(int(word), 0, 12), bitfieldExtract(int(word), 12, 12)) / 2047.0;
    uint cosine = word >> 24;
    return Cone(from_octahedron(axis), cosine == 0u ? -1.0 : float(cosine) / 255.0);
}

#endif
