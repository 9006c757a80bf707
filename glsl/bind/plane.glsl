// The triangle under a fragment, by its neighbours.
#ifndef BIND_PLANE_GLSL
#define BIND_PLANE_GLSL

// Unit normal of the plane of the pixel's place `p` and its neighbours', which all lie on the one triangle, on the side of
// `wo`.
vec3 plane_normal(vec3 p, vec3 wo) {
    vec3 normal = cross(dFdx(p), dFdy(p));
    float length2 = dot(normal, normal);
    normal = length2 > 0.0 ? normal * inversesqrt(length2) : wo;
    return dot(normal, wo) < 0.0 ? -normal : normal;
}

#endif
