// Set 1: what a ray finds, shaded: place, frame and material of the nearest hit.
//
// The including shader defines ANISOTROPIC before this line, as lib/bsdf.glsl asks of it.
#ifndef BIND_HIT_GLSL
#define BIND_HIT_GLSL

#include "bind/nearest.glsl"
#include "lib/bsdf/parameters.glsl"
#include "lib/frame.glsl"

// false: no material has any. Tangents are fetched where either may need them.
layout(constant_id = 59) const bool HIT_NORMAL_MAPS = true;

layout(set = SET_scene, binding = SCENE_HIT_MATERIALS) uniform utexture2D hit_materials;

struct HitSurface {
    vec3 position;  // world, on the triangle
    vec3 geometric_normal;  // unit, on the side that the ray came from
    mat3 world_from_local;  // columns: tangent, bitangent, normal; as shading_frame() of bind/surface.glsl
    uint model;
    BsdfParameters parameters;
    bool drawn;  // false: a luminaire, or the back of a one-sided surface, which reflect nothing
};

uvec4 hit_material(uint material, uint row) {
    return texelFetch(hit_materials, in_records(material, row), 0);
}

vec3 halves(uvec2 words) { return vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x); }

// Bilinear, repeating; texture coordinates begin at the image's lower left, texels at its top.
vec3 hit_sample(HitTexture texture, vec2 uv) {
    ivec2 size = ivec2(texture.width, texture.height);
    // Before it is scaled, what repeats costs nothing of the precision.
    uv -= floor(uv);
    vec2 at = vec2(uv.x, 1.0 - uv.y) * vec2(size) - 0.5;
    vec2 s = at - floor(at);
    ivec2 low = ivec2(floor(at));
    low = mix(low, low + size, lessThan(low, ivec2(0)));
    low = min(low, size - 1);
    int below = low.y + 1 < size.y ? low.y + 1 : 0;
    uvec4 top = hit_texel(texture.first + uint(low.y * size.x + low.x));
    uvec4 bottom = hit_texel(texture.first + uint(below * size.x + low.x));
    vec3 upper = mix(halves(top.xy), halves(top.zw), s.x);
    return mix(upper, mix(halves(bottom.xy), halves(bottom.zw), s.x), s.y);
}

// A material's constants, with its textures' values in the place of some, and the texel of its normal map;
// w of it: whether there is one.
HitMaterial material_at(uint material, vec2 uv, out vec4 normal_texel) {
    normal_texel = vec4(0.0);
    uvec4 color = hit_material(material, 0u);
    uvec4 specular = hit_material(material, 1u);
    vec4 a = uintBitsToFloat(hit_material(material, 2u));
    vec4 b = uintBitsToFloat(hit_material(material, 3u));
    uvec4 c = hit_material(material, 4u);
    vec3 coat = uintBitsToFloat(c.xyz);
    HitMaterial m = HitMaterial(uintBitsToFloat(color.xyz), color.w, uintBitsToFloat(specular.xyz), specular.w,
            a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, coat.x, coat.y, coat.z, c.w);
    for (uint i = 0u; i < m.textures; ++i) {
        uvec4 words = hit_material(material, HIT_MATERIAL_TEXELS + i);
        vec3 value = hit_sample(HitTexture(words.x, words.y, words.z, words.w), uv);
        uint p = words.x;
        if (p == 0u) m.color = value;
        if (p == 1u) m.specular = value;
        if (p == 2u) m.roughness = value.x;
        // Texels beyond 1, which only files of numbers have, would end the alphas.
        if (p == 3u) m.aspect = sqrt(max(1.0 - 0.9 * value.x, 1e-4));
        if (p == 4u) m.sigma = value.x;
        if (p == 5u) m.eta = value.x;
        if (p == 6u) m.metallic = value.x;
        if (p == 7u) m.specular_tint = value.x;
        if (p == 8u) m.sheen = value.x;
        if (p == 9u) m.sheen_tint = value.x;
        if (p == 10u) m.clearcoat = value.x;
        if (p == 11u) m.clearcoat_gloss = value.x;
        if (p == 12u) m.subsurface = value.x;
        if (p == 13u) normal_texel = vec4(value, 1.0);
    }
    return m;
}

// Roughness, as `reference::shading` has it, and alphas as alphas() of bind/surface.glsl.
BsdfParameters parameters_of(HitMaterial m, float aspect) {
    bool squared = (m.kind & HIT_SQUARED_ROUGHNESS) != 0u;
    float alpha = squared ? m.roughness * m.roughness : m.roughness;
    float roughness = squared ? m.roughness : sqrt(max(m.roughness, 0.0));
    vec2 alphas = max(vec2(alpha / aspect, alpha * aspect), vec2(1e-3));
    return BsdfParameters(m.color, m.specular, alphas.x, alphas.y, m.sigma, m.eta, m.metallic, roughness,
            m.specular_tint, m.sheen, m.sheen_tint, m.clearcoat, m.clearcoat_gloss, m.subsurface);
}

// Of which the ray's side has the length 1, however small or thin the triangle is.
vec3 side_of(vec3 e1, vec3 e2, vec3 direction) {
    vec3 reach = max(abs(e1), abs(e2));
    float scale = 1.0 / max(max(reach.x, reach.y), max(reach.z, 1e-30));
    vec3 n = cross(e1 * scale, e2 * scale);
    float n2 = dot(n, n);
    n = n2 > 1e-30 ? n * inversesqrt(n2) : -direction;
    return dot(n, direction) > 0.0 ? -n : n;
}

// What `nearest_hit` found along the unit vector `direction`; anything, but finite, where it found nothing.
HitSurface hit_surface(Hit hit, vec3 direction) {
    uint triangle = hit.triangle == NO_HIT ? 0u : hit.triangle;
    uint nodes = bvh_header().nodes;
    vec3 weights = vec3(1.0 - hit.weights.x - hit.weights.y, hit.weights);
    uint corner = BVH_HEADER_TEXELS + nodes + triangle * BVH_TRIANGLE_TEXELS;
    vec3 a = uintBitsToFloat(bvh_texel(corner).xyz);
    vec3 e1 = uintBitsToFloat(bvh_texel(corner + 1u).xyz) - a;
    vec3 e2 = uintBitsToFloat(bvh_texel(corner + 2u).xyz) - a;
    uint texel = HIT_ORDERS * nodes + triangle * HIT_TRIANGLE_TEXELS;
    uvec4 na = hit_texel(texel);
    uvec4 nb = hit_texel(texel + 1u);
    uvec4 nc = hit_texel(texel + 2u);
    vec4 uv_bc = uintBitsToFloat(hit_texel(texel + 3u));
    vec2 uv = weights.x * uintBitsToFloat(uvec2(nb.w, nc.w)) + weights.y * uv_bc.xy + weights.z * uv_bc.zw;
    mat3 normals = mat3(uintBitsToFloat(na.xyz), uintBitsToFloat(nb.xyz), uintBitsToFloat(nc.xyz));

    uint surface = na.w;
    vec4 t = vec4(0.0);
    if (ANISOTROPIC || HIT_NORMAL_MAPS) {
        uint place = (surface & HIT_TANGENTS) != 0u ? surface & ~HIT_TANGENTS : 0u;
        uvec4 ta = hit_texel(place);
        vec4 tb = uintBitsToFloat(hit_texel(place + 1u));
        vec3 tc = uintBitsToFloat(hit_texel(place + 2u).xyz);
        if (place != 0u) {
            t = vec4(weights.x * uintBitsToFloat(ta.xyz) + weights.y * tb.xyz + weights.z * tc, tb.w);
            surface = ta.w;
        }
    }
    vec4 normal_texel;
    HitMaterial material = material_at(surface & ((1u << HIT_MATERIAL_BITS) - 1u), uv, normal_texel);
    bool two_sided = (material.kind & HIT_TWO_SIDED) != 0u;

    HitSurface s;
    s.position = a + weights.y * e1 + weights.z * e2;
    s.geometric_normal = side_of(e1, e2, direction);
    vec3 n = normals * weights;
    // Normals that cancel between corners have no direction.
    n = dot(n, n) > 1e-20 ? normalize(n) : vec3(0.0, 1.0, 0.0);
    float turn = two_sided && dot(n, direction) > 0.0 ? -1.0 : 1.0;
    vec3 along = tangent_to(n, t.xyz);
    if (HIT_NORMAL_MAPS && normal_texel.w > 0.0) {
        n = mapped_normal(n, t, normal_texel.xyz, turn, -direction);
    } else {
        n *= turn;
    }
    vec3 tangent = tangent_to(n, along);
    s.world_from_local = mat3(tangent, cross(n, tangent), n);
    s.model = material.kind & ((1u << HIT_MODEL_BITS) - 1u);
    // A tangent of length 0 has no direction to stretch along.
    s.parameters = parameters_of(material, dot(t.xyz, t.xyz) > 0.0 ? material.aspect : 1.0);
    s.drawn = hit.triangle != NO_HIT && (surface & HIT_LUMINAIRE) == 0u && (hit.front || two_sided);
    return s;
}

#endif
