// Light that comes by way of other surfaces, and that of lights whose shadows are wanted: per pixel one light drawn from each
// tree, and a path as far as what drawing lights leaves to it. The mean over frames is that of all paths from the eye.
//
// At each vertex of the path, virtual lights stand for the Lambertian share of what the surfaces beyond reflect: of that, the
// part that does not grow beyond a bound (Kollig and Keller 2004, Illumination in the Presence of Weak Singularities). The
// rest is found by the path: the light that the next vertex reflects, but for what was gathered of it.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "lib/light.glsl"
#include "lib/random.glsl"
#include "gather/vertex.glsl"
#include "bind/hit.glsl"
#include "gather/trees.glsl"
#include "gather/visible.glsl"

layout(local_size_x = GATHER_SIDE, local_size_y = GATHER_SIDE) in;
layout(constant_id = 54) const bool SHADOWS = true;
layout(constant_id = 55) const bool POINTS = true;
layout(constant_id = 56) const bool INDIRECT = true;
layout(constant_id = 57) const bool LAMBERT = false;
layout(push_constant, std430) uniform PushBlock { GatherConstants gather; };
layout(set = SET_gather, binding = GATHER_SUMS, rgba32f) uniform image2DArray sums;

// Of a single frame: no picture is brighter.
const vec3 MOST_RADIANCE = vec3(1e30);
// Bounces before a path may be ended by chance, and the least that are then left of it.
const uint SAFE_BOUNCES = 2u;
// No bound: lights of the scene are drawn alone.
const float UNBOUNDED = 1e30;

uint random_state;

float random() {
    random_state = hash(random_state);
    return unit(random_state);
}

vec2 random_pair() { return vec2(random(), random()); }

// What one light of a tree adds. A virtual light's light is shared with paths.
vec3 drawn(Vertex v, uvec2 tree, float u, float bound, uint most_bounces, bool with_normals) {
    Lit lit = Lit(v.position, v.world_from_local[2], bound);
    Drawn choice = draw_light(tree, lit, u, random_state, with_normals);
    VirtualLight light = gathered_light(tree, choice.light);
    vec3 to_light = light.position - v.position;
    float d2 = dot(to_light, to_light);
    vec3 direction = to_light * inversesqrt(max(d2, TINY));
    vec3 wi = direction * v.world_from_local;
    vec3 reflected = response(v, wi);
    float arriving = 0.0;
    if (with_normals) {
        float facing = -dot(direction, unpack_unit(light.normal));
        float share = bound < UNBOUNDED ? gathered_share(bound, reflected, wi.z, facing, d2) : 1.0;
        arriving = light.extra <= most_bounces ? max(facing, 0.0) * share / max(d2, 1e-12) : 0.0;
    } else {
        float inverse_range2 = uintBitsToFloat(light.extra);
        arriving = falloff(d2, inverse_range2, inverse_range2 > 0.0 ? 1e-4 : 1e-12);
    }
    arriving = wi.z > 0.0 && dot(direction, v.geometric) > 0.0 && choice.probability > 0.0 ? arriving : 0.0;
    vec3 sum = reflected * light.color * (arriving / max(choice.probability, TINY));
    bool dark = sum == vec3(0.0);
    if (SHADOWS && !dark) dark = occluded(v.origin, direction, 0.0, sqrt(d2) * (1.0 - 1e-4));
    return dark ? vec3(0.0) : sum;
}

// Light of the scene's own lights.
vec3 own_lights(Vertex v) {
    vec3 sum = vec3(0.0);
    if (gather.points.y > 0u) sum += drawn(v, gather.points, random(), UNBOUNDED, 0u, ALL_AROUND);
    if (gather.emitters.y > 0u) sum += drawn(v, gather.emitters, random(), UNBOUNDED, 0u, WITH_NORMALS);
    return sum;
}

vec3 virtual_lights(Vertex v, float u, uint bounces) {
    if (gather.virtuals.y == 0u || bounces == 0u) return vec3(0.0);
    return drawn(v, gather.virtuals, u, gather.bound, bounces, WITH_NORMALS);
}

// In 16 frames a pixel of a block of 4 × 4 draws from all strata, in each frame its block does.
float stratified(uvec2 pixel) {
    uint place = (pixel.x & 3u) * 4u + (pixel.y & 3u);
    uint shift = hash(hash(pixel.x >> 2) ^ (pixel.y >> 2) ^ gather.seed);
    // 7 and 16 have no common divisor.
    uint stratum = (place * 7u + gather.frame + shift) % GATHER_STRATA;
    return (float(stratum) + random()) * (1.0 / float(GATHER_STRATA));
}

// Along a sampled direction: light of the background, or the next vertex with what the path has to find there.
struct Step {
    Vertex vertex;
    vec3 throughput;
    bool goes_on;
};

Step step_from(Vertex v, vec3 throughput, inout vec3 radiance) {
    vec3 wi = bsdf_sample(v.sampling, random_pair());
    float pdf = bsdf_pdf(v.sampling, wi);
    vec3 direction = v.world_from_local * wi;
    bool leaves = pdf > 0.0 && wi.z > 0.0 && dot(direction, v.geometric) > 0.0;
    vec3 reflected = leaves ? response(v, wi) : vec3(0.0);
    throughput *= reflected / max(pdf, TINY);
    Step next = Step(v, throughput, false);
    if (throughput == vec3(0.0)) return next;
    // Gathering takes over whatever is farther.
    float reach = LAMBERT ? inversesqrt(gather.bound) : 1e30;
    Hit hit = nearest_hit(v.origin, direction, reach);
    if (hit.triangle == NO_HIT) {
        radiance += throughput * frame.background;
        return next;
    }
    HitSurface s = hit_surface(hit, direction);
    vec3 n = s.geometric_normal;
    float share = gathered_share(gather.bound, reflected, wi.z, -dot(n, direction), sqr(hit.t));
    surface_model = s.model;
    vec3 origin = offset_origin(s.position, n, max(greatest(abs(s.position)), hit.t));
    next.vertex = vertex_at(s.position, origin, n, s.world_from_local, s.parameters, -direction);
    next.vertex.taken = bsdf_lambert(s.parameters) * (share * INV_PI);
    next.goes_on = s.drawn && !(next.vertex.is_lambert && share >= 1.0);
    return next;
}

vec3 indirect(Vertex v, float u) {
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    bool goes_on = true;
    for (uint bounce = 0u; bounce <= gather.bounces && goes_on; ++bounce) {
        if (bounce > 0u) radiance += throughput * own_lights(v);
        radiance += throughput * virtual_lights(v, bounce == 0u ? u : random(), gather.bounces - bounce);
        if (bounce >= SAFE_BOUNCES) {
            float survival = min(greatest(abs(throughput)), 0.95);
            goes_on = random() < survival;
            throughput /= max(survival, TINY);
        }
        if (goes_on) {
            Step next = step_from(v, throughput, radiance);
            v = next.vertex;
            throughput = next.throughput;
            goes_on = next.goes_on;
        }
    }
    return radiance;
}

void add(ivec2 pixel, uint layer, vec3 radiance) {
    ivec3 texel = ivec3(pixel, layer);
    // Paths with next to no probability.
    radiance = clamp(radiance, -MOST_RADIANCE, MOST_RADIANCE);
    imageStore(sums, texel, imageLoad(sums, texel) + vec4(radiance, 0.0));
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, gather.row);
    if (pixel.x >= frame.size.x || pixel.y >= frame.size.y) return;
    Visible seen = visible_at(ivec2(pixel));
    if (!seen.exists) return;
    random_state = hash(hash(pixel.x + (pixel.y << 16)) ^ (gather.seed * GATHER_STRATA + gather.frame));
    if (POINTS) {
        vec3 direct = drawn(seen.vertex, gather.points, stratified(pixel), UNBOUNDED, 0u, ALL_AROUND);
        add(ivec2(pixel), GATHER_SUBSETS + gather.subset, direct);
    }
    if (INDIRECT) add(ivec2(pixel), gather.subset, indirect(seen.vertex, stratified(pixel)));
}
