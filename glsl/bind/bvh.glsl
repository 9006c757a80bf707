// Set 1: what hides lights, and whether anything does. One texture of words holds the tree, the triangles and the
// masks: lavapipe vectorises texel fetches, and the storage buffers that every device grants a stage are all taken.
#ifndef BIND_BVH_GLSL
#define BIND_BVH_GLSL

#include "lib/bvh.glsl"

layout(set = SET_scene, binding = SCENE_BVH) uniform utexture2DArray bvh_texels;

uvec4 bvh_texel(uint index) {
    return texelFetch(bvh_texels, ivec3(
            int(index & ((1u << BVH_WIDTH_LOG2) - 1u)),
            int((index >> BVH_WIDTH_LOG2) & ((1u << BVH_HEIGHT_LOG2) - 1u)),
            int(index >> (BVH_WIDTH_LOG2 + BVH_HEIGHT_LOG2))), 0);
}

BvhNode bvh_node(uint index) {
    uvec4 lower = bvh_texel(BVH_NODE_TEXELS * index);
    uvec4 upper = bvh_texel(BVH_NODE_TEXELS * index + 1u);
    return BvhNode(uintBitsToFloat(lower.xyz), lower.w, uintBitsToFloat(upper.xyz), upper.w);
}

// Whether the mask leaves the place of a hit: bilinear, at full size, repeating.
bool mask_holds(uint texel, vec3 weights) {
    vec4 uv_ab = uintBitsToFloat(bvh_texel(texel));
    uvec4 rest = bvh_texel(texel + 1u);
    weights /= weights.x + weights.y + weights.z;
    vec2 uv = weights.x * uv_ab.xy + weights.y * uv_ab.zw + weights.z * uintBitsToFloat(rest.xy);
    vec2 size = vec2(rest.w & 0xffffu, rest.w >> 16);
    vec2 at = vec2(uv.x, 1.0 - uv.y) * size - 0.5;
    vec2 corner = floor(at);
    vec2 s = at - corner;
    // The remainder's own rounding can end on the far border.
    vec2 place = min(corner - size * floor(corner / size), size - 1.0);
    uint word = rest.z + uint(place.y * size.x + place.x);
    vec4 quad = unpackUnorm4x8(bvh_texel(word >> 2)[word & 3u]);
    vec2 rows = mix(quad.xz, quad.yw, s.x);
    return mix(rows.x, rows.y, s.y) >= 0.5;
}

bool triangle_hides(BvhRay ray, uint texel) {
    uvec4 a = bvh_texel(texel);
    vec3 b = uintBitsToFloat(bvh_texel(texel + 1u).xyz);
    vec3 c = uintBitsToFloat(bvh_texel(texel + 2u).xyz);
    vec3 weights;
    bool met = triangle_met(ray, uintBitsToFloat(a.xyz), b, c, weights);
    return met && (a.w == 0u || mask_holds(a.w, weights));
}

// Whether anything is in the way from `origin` along the unit vector `direction` between two distances: a triangle from
// either side, but for what its mask cuts, or a luminaire that is seen. No light may be asked about by an origin on a
// surface: see offset_origin(). `t_max` should end before the light by 1e-5 of its distance where the light itself is
// an occluder or lies on one.
bool occluded(vec3 origin, vec3 direction, float t_min, float t_max) {
    BvhRay ray = bvh_ray(origin, direction, t_min, t_max);
    uint end = bvh_texel(0u).w;
    uint index = 0u;
    bool hidden = false;
    while (index < end) {
        uint leaf = 0u;
        while (index < end && leaf == 0u) {
            BvhNode node = bvh_node(index);
            bool met = box_met(ray, node.lower, node.upper);
            leaf = met ? node.triangles : 0u;
            index = met ? index + 1u : node.skip;
        }
        uint first = leaf >> BVH_COUNT_BITS;
        uint count = leaf & ((1u << BVH_COUNT_BITS) - 1u);
        for (uint i = 0u; i < count; ++i) {
            hidden = hidden || triangle_hides(ray, first + i * BVH_TRIANGLE_TEXELS);
        }
        if (hidden) index = end;
    }
    return hidden;
}

#endif
