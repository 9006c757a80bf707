// Trees over lights that are gathered, and a light drawn from one: a walk down from the root that takes each child with the
// probability of its importance at the place that is lit (Conty Estévez and Kulla 2018, Importance Sampling of Many Lights).
#ifndef GATHER_TREES_GLSL
#define GATHER_TREES_GLSL

#include "lib/octahedron.glsl"
#include "lib/rows.glsl"

layout(set = SET_gather, binding = GATHER_LIGHTS) uniform utexture2D gathered_lights;

uvec4 gathered_texel(uint index) {
    return texelFetch(gathered_lights, in_rows(index, GATHERED_WIDTH_LOG2), 0);
}

// What is lit: places in a box, with normals in a cone.
struct Lit {
    vec3 center;
    vec3 extent;
    vec3 normal;
    float cosine;  // of the cone's half angle; 1: all are this one
    float bound;  // largest geometry term: how near a light may seem
};

// Which lights a tree holds: those with a normal and a cone of them, or points that shine all around, with a range.
const bool WITH_NORMALS = true;
const bool ALL_AROUND = false;

// Cosine between a receiver's direction and the nearest normal of a cone, at most: θ = angle − half − widening.
float cosine_in_cone(float cos_angle, float cos_half, float cos_widening) {
    float cos_wide = cos_half * cos_widening - sqrt(max((1.0 - sqr(cos_half)) * (1.0 - sqr(cos_widening)), 0.0));
    float sin_half = sqrt(max(1.0 - sqr(cos_half), 0.0));
    float sin_widening = sqrt(max(1.0 - sqr(cos_widening), 0.0));
    float sin_wide = sin_half * cos_widening + cos_half * sin_widening;
    // The cone and the widening reach around, or the direction is inside.
    if (sin_wide < 0.0 || cos_wide <= cos_angle) return 1.0;
    return cos_angle * cos_wide + sqrt(max(1.0 - sqr(cos_angle), 0.0)) * sin_wide;
}

// Of a node's squared radius: how near its lights are, as far as that counts, to a place among them. In a ball around the place
// the mean of 1/d² is 3 over the squared radius. With 1, the error of point lights with shadows (tests/indirect) after 16 rounds
// was 1.4 times as large.
const float INSIDE = 0.25;

// About what a node lights a place with, and 0 only where it lights it with nothing. Its box, and the cone or range.
float importance(Lit lit, vec3 lower, vec3 upper, uint word, float power, bool with_normals) {
    vec3 extent = 0.5 * (upper - lower) + lit.extent;
    vec3 offset = 0.5 * (lower + upper) - lit.center;
    float d2 = dot(offset, offset);
    float r2 = dot(extent, extent);
    float inverse = inversesqrt(max(max(d2, r2), 1e-24));
    float above = dot(lit.normal, offset) + dot(abs(lit.normal), extent);
    float geometry = clamp(above * inverse, 0.0, 1.0);
    float cos_widening = sqrt(max(1.0 - r2 * sqr(inverse), 0.0));
    if (lit.cosine < 1.0) {
        float tilted = cosine_in_cone(dot(lit.normal, offset) * inverse, lit.cosine, cos_widening);
        geometry = d2 <= r2 ? 1.0 : max(tilted, 0.0);
    }
    if (with_normals) {
        Cone cone = unpack_cone(word);
        float facing = cosine_in_cone(-dot(cone.axis, offset) * inverse, cone.cosine, cos_widening);
        geometry *= d2 <= r2 ? 1.0 : max(facing, 0.0);
    } else {
        // Out of range of all.
        vec3 outside = max(abs(offset) - extent, 0.0);
        float range = uintBitsToFloat(word);
        geometry *= dot(outside, outside) < sqr(range) ? 1.0 : 0.0;
    }
    return power * min(geometry / max(max(d2, INSIDE * r2), 1e-24), lit.bound);
}

// A light drawn from a tree by a number of [0, 1): its index, and the probability that it was it; 0 where there is none.
struct Drawn {
    uint light;
    float probability;
};

// A tree is its first texel and its lights.
Drawn draw_light(uvec2 tree, Lit lit, float u, uint seed, bool with_normals) {
    uint pair = 0u;
    uint first = 0u;
    uint count = tree.y;
    float probability = tree.y > 0u ? 1.0 : 0.0;
    uint level = 0u;
    while (count > 1u && probability > 0.0) {
        uint texel = tree.x + 4u * pair;
        uvec4 a = gathered_texel(texel);
        uvec4 b = gathered_texel(texel + 1u);
        uvec4 c = gathered_texel(texel + 2u);
        uvec4 d = gathered_texel(texel + 3u);
        vec2 powers = uintBitsToFloat(uvec2(c.w << 16, c.w & 0xffff0000u));
        float left = importance(lit, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), b.w, powers.x, with_normals);
        float right = importance(lit, uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz), d.w, powers.y, with_normals);
        float sum = left + right;
        float share = sum > 0.0 ? left / sum : 0.0;
        bool goes_right = u >= share;
        float taken = goes_right ? 1.0 - share : share;
        u = clamp((goes_right ? u - share : u) / max(taken, 1e-30), 0.0, 0.99999994);
        probability *= sum > 0.0 ? taken : 0.0;
        pair += goes_right ? a.w : 1u;
        first += goes_right ? a.w : 0u;
        count = goes_right ? count - a.w : a.w;
        // Each choice uses up bits of the number: new ones from below.
        ++level;
        if ((level & 7u) == 0u) u = (floor(u * 256.0) + unit(hash(seed ^ level))) * (1.0 / 256.0);
    }
    return Drawn(first, probability);
}

VirtualLight gathered_light(uvec2 tree, uint light) {
    // Where there is none, whatever stands there.
    uint texel = tree.x + 4u * (max(tree.y, 1u) - 1u) + 2u * light;
    uvec4 a = gathered_texel(texel);
    uvec4 b = gathered_texel(texel + 1u);
    return VirtualLight(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w);
}

#endif
