// Directions that skim the surface away from the viewer, where 1/(wi·h) of a coat without shadowing has its spike.
#ifndef LIB_BSDF_SKIMMING_GLSL
#define LIB_BSDF_SKIMMING_GLSL

#include "lib/bsdf/lobe_sampling.glsl"
#include "lib/bsdf/microfacet.glsl"

// With wi at the angle θ from −wo and c = wi·h = sin(θ/2), c is even in [0, reach): the density has the spike 1/c. There
// h = c wo + √(1 − c²)(cosψ up + sinψ across), ψ the azimuth about −wo, and tanψ is distributed as Cauchy's, of the scale
// alpha around slope (cosθo − c), about where D(h) is greatest.
struct Skimming {
    vec3 wo;
    vec3 up;
    vec3 across;
    float alpha;
    float slope;
    float reach;
};

Skimming skimming_setup(Ggx ggx, vec3 wo) {
    float sin2 = dot(wo.xy, wo.xy);
    vec2 side = sin2 > TINY ? vec2(-wo.y, wo.x) * inversesqrt(sin2) : vec2(0.0, 1.0);
    vec2 weighted = side * ggx.inv_alpha2;
    float alpha2 = 1.0 / dot(side, weighted);
    Skimming s;
    s.wo = wo;
    s.across = vec3(side, 0.0);
    s.up = cross(wo, s.across);
    s.alpha = sqrt(alpha2);
    s.slope = dot(wo.xy, weighted) * alpha2;
    s.reach = min(wo.z + ggx.stretch_o, 0.5);
    return s;
}

vec3 skimming_direction(Skimming s, vec2 xi) {
    float c = s.reach * xi.x;
    vec2 turn = circle(0.5 * xi.y + 0.25);
    vec3 azimuth = normalize(turn.x * s.up + (s.alpha * turn.y + s.slope * (s.wo.z - c) * turn.x) * s.across);
    return 2.0 * c * (c * s.wo + sqrt((1.0 - c) * (1.0 + c)) * azimuth) - s.wo;
}

// p(ψ)/(4 c reach).
float skimming_pdf(Skimming s, vec3 wi) {
    // Not wi alone: it is orthogonal to `up` but for a small rest, and so is wo exactly.
    vec3 sum = s.wo + wi;
    float c = 0.5 * length(sum);
    float x = dot(sum, s.up), y = dot(sum, s.across);
    if (x <= 0.0 || c >= s.reach) return 0.0;
    float azimuth = s.alpha * (sqr(x) + sqr(y)) / max(sqr(y - s.slope * (s.wo.z - c) * x) + sqr(s.alpha * x), TINY);
    return 0.25 * INV_PI * azimuth / max(c * s.reach, TINY);
}

#endif
