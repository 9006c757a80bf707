// A lobe's reflection of a light by quadrature in the coordinates of its proxy:
//
//   ∫ f cosθi dω over the light = ∫ f cosθi · (dω/dωq) · dωq over its image,   dω/dωq = |det M| / |M q|³
//
// What is integrated there is nearly a cosine, whatever the light's size, and every point lies on the light. Against the
// closed form of the cosine, what the proxy does not fit is no longer an error but a slower convergence.
#ifndef LIB_AREA_QUADRATURE_GLSL
#define LIB_AREA_QUADRATURE_GLSL

#include "lib/area/proxy.glsl"

// Gauss–Legendre on [0, 1] with 2, 4, 8 and 12 nodes, one after the other.
const float GAUSS_NODES[26] = float[](
        0.211324865, 0.788675135, 0.0694318442, 0.330009478, 0.669990522, 0.930568156,
        0.0198550718, 0.101666761, 0.237233795, 0.408282679, 0.591717321, 0.762766205,
        0.898333239, 0.980144928, 0.00921968288, 0.0479413718, 0.115048663, 0.206341023,
        0.316084251, 0.437383296, 0.562616704, 0.683915749, 0.793658977, 0.884951337,
        0.952058628, 0.990780317);
const float GAUSS_WEIGHTS[26] = float[](
        0.5, 0.5, 0.173927423, 0.326072577, 0.326072577, 0.173927423,
        0.0506142681, 0.111190517, 0.156853323, 0.181341892, 0.181341892, 0.156853323,
        0.111190517, 0.0506142681, 0.0235876682, 0.053469663, 0.0800391643, 0.101583713,
        0.116746268, 0.124573523, 0.124573523, 0.116746268, 0.101583713, 0.0800391643,
        0.053469663, 0.0235876682);

vec2 gauss(uint count, uint node) {
    uint first = count == 2u ? 0u : count == 4u ? 2u : count == 8u ? 6u : 14u;
    return vec2(GAUSS_NODES[first + node], GAUSS_WEIGHTS[first + node]);
}

// A direction towards a light and the solid angle that it stands for.
struct Point {
    vec3 wi;
    float weight;
};

// The same of a unit direction and a solid angle in the space of a proxy.
Point point_of(Proxy proxy, vec3 q, float weight) {
    vec3 w = proxy.local_from_q * q;
    float inverse = inversesqrt(max(dot(w, w), TINY));
    return Point(w * inverse, weight * proxy.determinant * inverse * inverse * inverse);
}

#endif
