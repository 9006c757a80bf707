// Rays against boxes and triangles. Every function is total: finite inputs give finite outputs and an answer, for any
// direction that is not zero and for triangles without area, which nothing meets.
//
// Triangles by Woop, Benthin and Wald 2013, Watertight Ray/Triangle Intersection: `precise` keeps the two products of
// an edge test apart, so that neighbours see exactly opposite numbers on their common edge and no ray slips through.
#ifndef LIB_BVH_GLSL
#define LIB_BVH_GLSL

#include "lib/math.glsl"

struct BvhRay {
    vec3 origin;
    // In cells of the nodes' grid: the origin with and without what it may be off by, and the direction's reciprocal,
    // which is finite.
    vec3 cell_above;
    vec3 cell_below;
    vec3 per_cell;
    mat3 shear;  // rows take the direction to +z of length 1; columns here, so multiply from the left
    float t_min;
    float t_max;
};

// A direction's component below this is this: over any scene's extent such a ray leaves its axis by less than an atom.
const float LEAST_COMPONENT = 1e-20;

BvhRay bvh_ray(BvhHeader grid, vec3 origin, vec3 direction, float t_min, float t_max) {
    BvhRay ray;
    ray.origin = origin;
    ray.t_min = t_min;
    ray.t_max = t_max;
    vec3 away = mix(vec3(LEAST_COMPONENT), vec3(-LEAST_COMPONENT), lessThan(direction, vec3(0.0)));
    ray.per_cell = grid.cell / mix(direction, away, lessThan(abs(direction), vec3(LEAST_COMPONENT)));
    vec3 cell = (origin - grid.lower) / grid.cell;
    vec3 error = 0.01 + abs(cell) * 2.4e-7;
    ray.cell_above = cell + error;
    ray.cell_below = cell - error;
    // z is the axis along which the direction is longest. Zeros and ones of the matrix are exact, so that a triangle's
    // corner becomes the same numbers in whichever triangle it is. The axes keep their cyclic order, so a triangle's winding
    // is what it was, or, against the axis, the reverse.
    vec3 d = direction;
    vec3 size = abs(d);
    if (size.x >= size.y && size.x >= size.z) {
        ray.shear = mat3(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0 / d.x, 0.0, 0.0);
        ray.shear[0].x = -d.y / d.x;
        ray.shear[1].x = -d.z / d.x;
    } else if (size.y >= size.z) {
        ray.shear = mat3(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0 / d.y, 0.0);
        ray.shear[0].y = -d.z / d.y;
        ray.shear[1].y = -d.x / d.y;
    } else {
        ray.shear = mat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 / d.z);
        ray.shear[0].z = -d.x / d.z;
        ray.shear[1].z = -d.y / d.z;
    }
    return ray;
}

// Whether the ray passes through a node's box between its ends; touched boxes are not lost to rounding (Ize 2013).
bool box_met(BvhRay ray, BvhNode node) {
    uvec3 cells = uvec3(node.x, node.y, node.z);
    vec3 a = (vec3(cells & 0xffffu) - ray.cell_above) * ray.per_cell;
    vec3 b = (vec3(cells >> 16) - ray.cell_below) * ray.per_cell;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, ray.t_min));
    float leave = min(min(far.x, far.y), min(far.z, ray.t_max));
    return enter <= leave * 1.0000005;
}

// Whether the ray meets a triangle between its ends, from either side, and where: `weights` of the corners, scaled by
// their sum, which is not 0 then, and the distance, scaled by the sum's absolute value.
//
// A hit counts only where its distance is above what the rounding of its own arithmetic can make of 0: from a point of
// the triangle's plane nothing is met, however large the triangle is. In terms of the distance from that plane, this
// leaves out what is nearer than about PLANE_ERROR of the farthest corner's distance. Without it, 59 % of the rays that
// leave the middle of a triangle of 1 km meet that triangle again.
const float PLANE_ERROR = 1e-6;

bool triangle_met(BvhRay ray, vec3 a, vec3 b, vec3 c, out vec3 weights, out float t) {
    precise vec3 pa = (a - ray.origin) * ray.shear;
    precise vec3 pb = (b - ray.origin) * ray.shear;
    precise vec3 pc = (c - ray.origin) * ray.shear;
    precise float u = pc.x * pb.y - pc.y * pb.x;
    precise float v = pa.x * pc.y - pa.y * pc.x;
    precise float w = pb.x * pa.y - pb.y * pa.x;
    weights = vec3(u, v, w);
    float sum = u + v + w;
    t = u * pa.z + v * pb.z + w * pc.z;
    float side = sum < 0.0 ? -1.0 : 1.0;
    bool within = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    vec3 reach = max(abs(pa), max(abs(pb), abs(pc)));
    float extent = max(reach.x, reach.y);
    float size = abs(sum);
    float least = max(ray.t_min * size, PLANE_ERROR * reach.z * extent * extent);
    t *= side;
    return within && size > 0.0 && t >= least && t <= ray.t_max * size;
}

// A start for rays that leave a surface at `p`, moved along the unit geometric normal `n` of the side they leave from.
// `way` is how far `p` was found along a ray or from the eye: that and its coordinates are the numbers that went into it.
// The move of 2⁻¹⁹ of the largest, some ten roundings, is more than float32 can have put `p` beside the surface;
// triangle_met() allows for the rounding of the rest, so t_min may be 0.
vec3 offset_origin(vec3 p, vec3 n, float way) { return p + n * (max(greatest(abs(p)), way) * 1.9073486e-6); }

#endif
