// Set 1: the nearest triangle along a ray, of those that bind/bvh.glsl knows.
#ifndef BIND_NEAREST_GLSL
#define BIND_NEAREST_GLSL

#include "bind/bvh.glsl"

layout(set = SET_scene, binding = SCENE_HITS) uniform utexture2D hit_texels;

uvec4 hit_texel(uint index) {
    return texelFetch(hit_texels, in_rows(index, BVH_WIDTH_LOG2), 0);
}

struct Hit {
    float t;  // along the direction
    uint triangle;  // of the tree, or NO_HIT
    vec2 weights;  // of the second and third corner
    bool front;  // the ray comes from the side from which the triangle winds counter-clockwise
};

// Takes a triangle that is nearer, and of two as near the one that comes first in the tree: the same hit in any order.
void nearer(BvhRay ray, uint texel, inout Hit hit) {
    vec3 weights;
    float scaled;
    bool met = triangle_hides(ray, texel, weights, scaled);
    float sum = weights.x + weights.y + weights.z;
    float t = scaled / abs(sum);
    if (met && (t < hit.t || (t == hit.t && texel < hit.triangle))) {
        vec3 axis = ray.shear[2];
        hit = Hit(t, texel, weights.yz / sum, sum * (axis.x + axis.y + axis.z) > 0.0);
    }
}

// A hit of a texel as one of a triangle.
Hit numbered(Hit hit, BvhHeader header) {
    if (hit.triangle != NO_HIT) {
        hit.triangle = (hit.triangle - BVH_HEADER_TEXELS - header.nodes) / BVH_TRIANGLE_TEXELS;
    }
    return hit;
}

// The nearest triangle from `origin` along `direction`, from either side, but for what its mask cuts; luminaires that are
// seen are among them. An origin on a surface has to be moved off it, see offset_origin().
#ifdef RAY_QUERIES

// As occluded(); what is found ends the query's ray, too.
Hit nearest_hit(vec3 origin, vec3 direction, float t_max) {
    BvhHeader header = bvh_header();
    BvhRay ray = bvh_ray(header, origin, direction, 0.0, t_max);
    uint triangles = BVH_HEADER_TEXELS + header.nodes;
    Hit hit = Hit(t_max, NO_HIT, vec2(0.0), false);
    if (!ray_allowed(origin, direction, 0.0, t_max)) return hit;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, ray_tree, gl_RayFlagsNoOpaqueEXT, 0xffu, origin, 0.0, direction, t_max);
    while (rayQueryProceedEXT(query)) {
        uint triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        uint texel = triangles + triangle * BVH_TRIANGLE_TEXELS;
        nearer(ray, texel, hit);
        if (hit.triangle == texel) rayQueryConfirmIntersectionEXT(query);
    }
    return numbered(hit, header);
}

#else

// The first node of a direction's order: near children come first, so that what is found early cuts off the rest.
uint hit_order(BvhHeader header, vec3 direction) {
    uvec3 negative = uvec3(lessThan(direction, vec3(0.0)));
    return (negative.x | negative.y << 1 | negative.z << 2) * header.nodes;
}

// A walk as `occluded`, over nodes in the order of the direction's octant, whose ray ends at what is found.
Hit nearest_hit(vec3 origin, vec3 direction, float t_max) {
    BvhHeader header = bvh_header();
    BvhRay ray = bvh_ray(header, origin, direction, 0.0, t_max);
    uint nodes = hit_order(header, direction);
    uint index = 0u;
    Hit hit = Hit(t_max, NO_HIT, vec2(0.0), false);
    while (index < header.nodes) {
        uint leaf = 0u;
        while (index < header.nodes && leaf == 0u) {
            [[unroll]] for (uint step = 0u; step < BVH_UNROLLED; ++step) {
                bool walking = index < header.nodes && leaf == 0u;
                uvec4 words = hit_texel(nodes + index);
                bool met = box_met(ray, BvhNode(words.x, words.y, words.z, words.w));
                bool is_leaf = words.w >= BVH_LEAF_BIT;
                leaf = walking && met && is_leaf ? words.w : leaf;
                index = walking ? (met || is_leaf ? index + 1u : words.w) : index;
            }
        }
        uint first = (leaf & ~BVH_LEAF_BIT) >> BVH_COUNT_BITS;
        uint count = leaf & ((1u << BVH_COUNT_BITS) - 1u);
        for (uint i = 0u; i < count; ++i) nearer(ray, first + i * BVH_TRIANGLE_TEXELS, hit);
        ray.t_max = hit.t;
    }
    return numbered(hit, header);
}

#endif

#endif
