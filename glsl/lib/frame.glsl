// Tangents for normals, and normals from maps.
#ifndef LIB_FRAME_GLSL
#define LIB_FRAME_GLSL

vec3 any_tangent(vec3 n) {
    float s = n.z < 0.0 ? -1.0 : 1.0;  // Duff et al. 2017
    float a = -1.0 / (s + n.z);
    return vec3(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

// `t` made orthogonal to n and unit, or any tangent where nothing is left of it.
vec3 tangent_to(vec3 n, vec3 t) {
    t -= n * dot(n, t);
    float t2 = dot(t, t);
    return t2 > 1e-12 ? t * inversesqrt(t2) : any_tangent(n);
}

// A normal map's normal bent just far enough to face the viewer: one that faces away belongs to a bump's far side,
// which the viewer cannot see, and would leave a black hole.
vec3 facing(vec3 n, vec3 wo) {
    const float least = 0.01;
    float away = least - dot(n, wo);
    return away > 0.0 ? normalize(n + away * wo) : n;
}

// The normal `n` by the texel of a normal map, applied on the front and turned with it; w of the tangent is the side of the
// bitangent, and without one there is nothing to go by.
vec3 mapped_normal(vec3 n, vec4 tangent, vec3 texel, float turn, vec3 wo) {
    vec3 t = tangent_to(n, tangent.xyz);
    vec3 m = texel * 2.0 - 1.0;
    float handed = tangent.w < 0.0 ? -1.0 : 1.0;
    vec3 mapped = m.x * t + m.y * handed * cross(n, t) + m.z * n;
    bool there = dot(mapped, mapped) > 1e-12 && dot(tangent.xyz, tangent.xyz) > 0.0;
    return there ? facing(turn * normalize(mapped), wo) : turn * n;
}

#endif
