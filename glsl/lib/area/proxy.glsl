// Linearly transformed cosines (Heitz et al. 2016) as coordinates: a linear map that takes a BSDF's lobe to one around
// +z that is about as wide as a cosine. What is left of the lobe in these coordinates is smooth.
#ifndef LIB_AREA_PROXY_GLSL
#define LIB_AREA_PROXY_GLSL

#include "lib/math.glsl"

// q = q_from_local · direction, up to length; local as in lib/bsdf.glsl.
struct Proxy {
    mat3 q_from_local;
    mat3 local_from_q;
    float determinant;  // |det local_from_q|
};

// Diffuse lobes: the cosine itself.
Proxy proxy_of_cosine() { return Proxy(mat3(1.0), mat3(1.0), 1.0); }

// In a frame (x, y, z): q = (a x + b z, y, c x + d z), stretched by `stretch` along the local tangent and bitangent where
// the lobe is anisotropic. `frame` has the axes as columns.
Proxy proxy_in(mat3 frame, float a, float b, float c, float d) {
    float determinant = a * d - b * c;
    mat3 q_from_frame = mat3(a, 0.0, c, 0.0, 1.0, 0.0, b, 0.0, d);
    mat3 frame_from_q = mat3(d, 0.0, -c, 0.0, determinant, 0.0, -b, 0.0, a) * (1.0 / determinant);
    return Proxy(q_from_frame * transpose(frame), frame * frame_from_q, 1.0 / abs(determinant));
}

// Coordinate of the fitted tables for n·wo, which rounding may leave above 1: √(1 − n·wo), fine where lobes change fast.
float view_coordinate(float cos_o) { return sqrt(clamp(1.0 - cos_o, 0.0, 1.0)); }

// z along the mirror direction 2 (n·wo) n − wo, y across the plane of incidence; any tangent where wo = n.
mat3 mirror_frame(vec3 wo) {
    vec2 across = vec2(-wo.y, wo.x);  // n × wo
    float length2 = dot(across, across);
    vec3 y = length2 > 1e-14 ? vec3(across * inversesqrt(length2), 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 z = vec3(-wo.xy, wo.z);
    return mat3(cross(y, z), y, z);
}

// A microfacet lobe from the four numbers of its fitted table, out of which its width, 2 alpha for GGX, is divided: as
// alpha → 0 they tend to (cosθo, 0, 0, cosθo).
Proxy proxy_of_microfacets(vec4 shape, float width, vec3 wo) {
    return proxy_in(mirror_frame(wo), shape.x, width * shape.y, width * shape.z, width * shape.w);
}

// The same for alpha_x ≠ alpha_y: the slopes of the facets, and with them the first two columns of the map from q, are
// stretched along the tangent and squeezed along the bitangent. `proxy` is that of the geometric mean.
Proxy proxy_anisotropic(Proxy proxy, vec2 alpha, vec3 wo) {
    float mean = sqrt(alpha.x * alpha.y);
    vec3 y = mirror_frame(wo)[1];
    // The plane of incidence in tangent coordinates: x = (y.y, −y.x), y = (y.x, y.y).
    mat2 turn = mat2(y.y, -y.x, y.x, y.y);
    mat2 stretch = transpose(turn) * mat2(alpha.x / mean, 0.0, 0.0, alpha.y / mean) * turn;
    mat2 squeeze = transpose(turn) * mat2(mean / alpha.x, 0.0, 0.0, mean / alpha.y) * turn;
    mat3 wide = mat3(vec3(stretch[0], 0.0), vec3(stretch[1], 0.0), vec3(0.0, 0.0, 1.0));
    mat3 narrow = mat3(vec3(squeeze[0], 0.0), vec3(squeeze[1], 0.0), vec3(0.0, 0.0, 1.0));
    return Proxy(narrow * proxy.q_from_local, proxy.local_from_q * wide, proxy.determinant);
}

#endif
