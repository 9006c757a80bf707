// What one light adds to a vertex: one that is drawn from a tree, or chosen among those that were drawn for half a tile.
#ifndef GATHER_LIGHT_GLSL
#define GATHER_LIGHT_GLSL

#include "bind/bvh.glsl"
#include "gather/random.glsl"
#include "gather/tile.glsl"
#include "gather/trees.glsl"
#include "gather/vertex.glsl"
#include "lib/light.glsl"

layout(constant_id = 54) const bool GATHER_SHADOWS = true;

// No bound, and no distance.
const float UNBOUNDED = 1e30;

// What arrives of a light, of its color; `facing` is the cosine at the light, 1 of one that shines all around.
float arriving(float d2, float facing, uint extra, uint most_bounces, bool with_normals) {
    if (with_normals) return extra <= most_bounces ? max(facing, 0.0) / max(d2, 1e-12) : 0.0;
    float inverse_range2 = uintBitsToFloat(extra);
    return falloff(d2, inverse_range2, inverse_range2 > 0.0 ? 1e-4 : 1e-12);
}

// What a light adds to a vertex, times `over`. The shadow ray leaves from beside the vertex, and so in another direction.
vec3 from_light(Vertex v, VirtualLight light, float over, float bound, uint most_bounces, bool with_normals) {
    vec3 to_light = light.position - v.position;
    float d2 = dot(to_light, to_light);
    vec3 direction = to_light * inversesqrt(max(d2, TINY));
    vec3 wi = direction * v.world_from_local;
    float facing = with_normals ? -dot(direction, unpack_unit(light.normal)) : 1.0;
    vec3 reflected = response(v, wi);
    float share = bound < UNBOUNDED ? gathered_share(bound, reflected, wi.z, facing, d2) : 1.0;
    float factor = over * share * arriving(d2, facing, light.extra, most_bounces, with_normals);
    bool lit = wi.z > 0.0 && dot(direction, v.geometric) > 0.0;
    vec3 sum = lit ? reflected * light.color * factor : vec3(0.0);
    bool dark = sum == vec3(0.0);
    vec3 way = light.position - v.origin;
    float reach = length(way);
    if (GATHER_SHADOWS && !dark) dark = occluded(v.origin, way / max(reach, TINY), 0.0, reach * (1.0 - 1e-6));
    return dark ? vec3(0.0) : clamp(sum, -MAX_RADIANCE, MAX_RADIANCE);
}

// One light of a tree, of those nearer than `within`.
vec3 drawn(Vertex v, uvec2 tree, float within, float bound, uint most_bounces, bool with_normals) {
    Lit lit = Lit(v.position, vec3(0.0), v.world_from_local[2], 1.0, bound);
    Drawn choice = draw_light(tree, lit, random(), random_state, with_normals);
    float over = choice.probability > 0.0 ? 1.0 / choice.probability : 0.0;
    VirtualLight light = gathered_light(tree, choice.light);
    over = distance(light.position, v.position) < within ? over : 0.0;
    return from_light(v, light, over, bound, most_bounces, with_normals);
}

// One of the lights drawn for half a tile, of those not nearer than `beyond`, chosen by about what it adds unless it is
// hidden (Talbot et al. 2005, Importance Resampling for Global Illumination).
vec3 chosen(Vertex v, uint first, uvec2 tree, float beyond, float bound, uint most_bounces, bool with_normals) {
    float u = random();
    float sum = 0.0;
    float target = 1.0;
    uint light = 0u;
    for (uint i = first; i < first + GATHER_DRAWN; ++i) {
        Candidate c = tile_lights[i];
        vec3 to_light = c.position - v.position;
        float d2 = dot(to_light, to_light);
        vec3 direction = to_light * inversesqrt(max(d2, TINY));
        float cosine = dot(direction, v.world_from_local[2]);
        bool lit = cosine > 0.0 && dot(direction, v.geometric) > 0.0 && d2 >= sqr(beyond);
        float facing = with_normals ? -dot(direction, c.normal) : 1.0;
        float geometry = lit ? cosine * arriving(d2, facing, c.extra, most_bounces, with_normals) : 0.0;
        float about = c.power * min(geometry, bound);
        float weight = about * c.weight;
        sum += weight;
        // Whether this one takes the place of those before; what is left of the number decides on.
        float at = u * sum;
        bool takes = at < weight;
        float rest = takes ? weight : sum - weight;
        u = rest > 0.0 ? min((takes ? at : at - weight) / rest, 0.99999994) : u;
        light = takes ? c.light : light;
        target = takes ? about : target;
    }
    return from_light(v, gathered_light(tree, light), sum / max(target, TINY), bound, most_bounces, with_normals);
}

#endif
