// Tangents for normals.
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

#endif
