// Set 1: what hides lights, and whether anything does. One texture of words holds the tree, the triangles and the
// masks. In compute on lavapipe a storage image would be faster by 1.12 to 1.27 in CPU time a ray, as for the lights, a
// storage buffer by 0.95 to 1.25; but of both the four that every device grants a stage are taken. A texture array would
// be slower by 1.05.
#ifndef BIND_BVH_GLSL
#define BIND_BVH_GLSL

#include "lib/bvh.glsl"
#include "lib/rows.glsl"

// lavapipe runs the look-up of a mask for every triangle that is tested, masked or not: a ray of a scene without masks
// would take 1.15 to 1.3 times as long.
layout(constant_id = 49) const bool OCCLUDER_MASKS = true;

layout(set = SET_scene, binding = SCENE_BVH) uniform utexture2D bvh_texels;

uvec4 bvh_texel(uint index) {
    return texelFetch(bvh_texels, in_rows(index, BVH_WIDTH_LOG2), 0);
}

BvhHeader bvh_header() {
    uvec4 lower = bvh_texel(0u);
    uvec4 cell = bvh_texel(1u);
    return BvhHeader(uintBitsToFloat(lower.xyz), lower.w, uintBitsToFloat(cell.xyz), cell.w);
}

BvhNode bvh_node(uint index) {
    uvec4 words = bvh_texel(BVH_HEADER_TEXELS + index);
    return BvhNode(words.x, words.y, words.z, words.w);
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

// As triangle_met(), of the triangle from a texel on, where its mask leaves it.
bool triangle_hides(BvhRay ray, uint texel, out vec3 weights, out float t) {
    uvec4 a = bvh_texel(texel);
    vec3 b = uintBitsToFloat(bvh_texel(texel + 1u).xyz);
    vec3 c = uintBitsToFloat(bvh_texel(texel + 2u).xyz);
    bool met = triangle_met(ray, uintBitsToFloat(a.xyz), b, c, weights, t);
    if (!OCCLUDER_MASKS) return met;
    return met && (a.w == 0u || mask_holds(a.w, weights));
}

// Nodes of a walk that share an iteration. lavapipe ends all loops of an invocation after 65,535 iterations in all,
// silently: a ray among 100,000 triangles takes 25 of them in the mean and has taken 360 at most, where one node an
// iteration would take three times as many. A shader that asks about many lights adds them up.
const uint BVH_UNROLLED = 4u;

// Whether anything is in the way from `origin` along the unit vector `direction` between two distances: a triangle from
// either side, but for what its mask cuts, or a luminaire that is seen. An origin on a surface has to be moved off it,
// see offset_origin(). `t_max` should end before the light by 1e-5 of its distance where the light itself is an occluder
// or lies on one.
#ifdef RAY_QUERIES

layout(set = SET_scene, binding = SCENE_RAY_TREE) uniform accelerationStructureEXT ray_tree;

// Vulkan leaves it open what other rays than these do.
bool ray_allowed(vec3 origin, vec3 direction, float t_min, float t_max) {
    bvec3 infinite = equal(floatBitsToUint(origin) & 0x7f800000u, uvec3(0x7f800000u));
    bvec3 nowhere = equal(floatBitsToUint(direction) & 0x7f800000u, uvec3(0x7f800000u));
    return !any(infinite) && !any(nowhere) && dot(direction, direction) > 0.5 && t_min >= 0.0 && t_max > t_min;
}

// The driver's tree says which triangles a ray may meet; of these, what meets it is decided as in the walk.
bool occluded(vec3 origin, vec3 direction, float t_min, float t_max) {
    BvhHeader header = bvh_header();
    BvhRay ray = bvh_ray(header, origin, direction, t_min, t_max);
    uint triangles = BVH_HEADER_TEXELS + header.nodes;
    if (!ray_allowed(origin, direction, t_min, t_max)) return false;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, ray_tree, gl_RayFlagsNoOpaqueEXT, 0xffu, origin, t_min, direction, t_max);
    bool hidden = false;
    while (!hidden && rayQueryProceedEXT(query)) {
        uint triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        vec3 weights;
        float t;
        hidden = triangle_hides(ray, triangles + triangle * BVH_TRIANGLE_TEXELS, weights, t);
    }
    return hidden;
}

#else

// A walk over the tree without a stack. Four children a node with a stack took as long, on lavapipe. The leaf's
// triangles wait until every lane of a group has a leaf or is done: lavapipe executes what it masks.
bool occluded(vec3 origin, vec3 direction, float t_min, float t_max) {
    BvhHeader header = bvh_header();
    BvhRay ray = bvh_ray(header, origin, direction, t_min, t_max);
    uint index = 0u;
    bool hidden = false;
    while (index < header.nodes) {
        uint leaf = 0u;
        while (index < header.nodes && leaf == 0u) {
            [[unroll]] for (uint step = 0u; step < BVH_UNROLLED; ++step) {
                bool walking = index < header.nodes && leaf == 0u;
                BvhNode node = bvh_node(index);
                bool met = box_met(ray, node);
                bool is_leaf = node.next >= BVH_LEAF_BIT;
                leaf = walking && met && is_leaf ? node.next : leaf;
                index = walking ? (met || is_leaf ? index + 1u : node.next) : index;
            }
        }
        uint first = (leaf & ~BVH_LEAF_BIT) >> BVH_COUNT_BITS;
        uint count = leaf & ((1u << BVH_COUNT_BITS) - 1u);
        vec3 weights;
        float t;
        for (uint i = 0u; i < count; ++i) {
            hidden = hidden || triangle_hides(ray, first + i * BVH_TRIANGLE_TEXELS, weights, t);
        }
        if (hidden) index = header.nodes;
    }
    return hidden;
}

#endif

#endif
