// A lobe's reflection of a uniform light by quadrature in the polar coordinates of its proxy.
//
//   ∫ f cosθi dω over the cone = ∫∫ f cosθi · (dω/dωq) · dωq,   dω/dωq = |det M| / |M q|³
//
// With the density (1 + cosθ)/2 over the whole sphere, u = ((1 + cosθ)/2)², what is integrated over (φ, u) is nearly
// constant where the proxy fits, whatever the light's size: every point lies on the light, none is wasted. Against the
// closed form of the cosine alone, what the proxy does not fit is no longer an error but a slower convergence.
#ifndef LIB_AREA_QUADRATURE_GLSL
#define LIB_AREA_QUADRATURE_GLSL

#include "lib/area/cone.glsl"

// Gauss–Legendre on [0, 1] with 2, 4 and 12 nodes, one after the other.
const float GAUSS_NODES[18] = float[](
        0.211324865, 0.788675135, 0.0694318442, 0.330009478, 0.669990522, 0.930568156,
        0.00921968288, 0.0479413718, 0.115048663, 0.206341023, 0.316084251, 0.437383296,
        0.562616704, 0.683915749, 0.793658977, 0.884951337, 0.952058628, 0.990780317);
const float GAUSS_WEIGHTS[18] = float[](
        0.5, 0.5, 0.173927423, 0.326072577, 0.326072577, 0.173927423,
        0.0235876682, 0.053469663, 0.0800391643, 0.101583713, 0.116746268, 0.124573523,
        0.124573523, 0.116746268, 0.101583713, 0.0800391643, 0.053469663, 0.0235876682);
const uint RADIAL = 2u;  // nodes along θ

vec2 gauss(uint count, uint node) {
    uint i = (count == 2u ? 0u : count == 4u ? 2u : 6u) + node;
    return vec2(GAUSS_NODES[i], GAUSS_WEIGHTS[i]);
}

// A direction of the cone and the solid angle that it stands for.
struct ConePoint {
    vec3 wi;
    float weight;
};

// The point at `along` of [0, 1] of an interval of cosθ; `width` is the share of azimuth.
ConePoint cone_point(Proxy proxy, vec2 e, vec2 interval, float along, float width) {
    vec2 half_cos = 0.5 + 0.5 * interval;
    float u = mix(sqr(half_cos.y), sqr(half_cos.x), along);
    float g = sqrt(u);
    float cosine = 2.0 * g - 1.0;
    float sine = 2.0 * sqrt(max(g - u, 0.0));
    vec3 w = proxy.local_from_q * vec3(sine * e, cosine);
    float inverse = inversesqrt(max(dot(w, w), TINY));
    // u₂ − u₁ by factors: the squares of a far light's interval would cancel. dcosθ = du / g.
    float du = (half_cos.y - half_cos.x) * (half_cos.y + half_cos.x);
    float jacobian = proxy.determinant * inverse * inverse * inverse;
    return ConePoint(w * inverse, width * du * jacobian / max(g, 1e-4));
}

#endif
