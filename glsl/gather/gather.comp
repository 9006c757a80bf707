// Light that comes by way of other surfaces, and that of lights whose shadows are wanted: per pixel one light of each tree,
// chosen among some that were drawn for its tile, and a path as far as that light leaves it something to find. The mean over
// frames is that of all paths from the eye.
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
#include "gather/tile.glsl"
#include "gather/visible.glsl"

layout(local_size_x = GATHER_SIDE, local_size_y = GATHER_SIDE) in;
layout(constant_id = 54) const bool GATHER_SHADOWS = true;
layout(constant_id = 55) const bool GATHER_POINTS = true;
layout(constant_id = 56) const bool GATHER_INDIRECT = true;
layout(push_constant, std430) uniform PushBlock { GatherConstants gather; };
layout(set = SET_gather, binding = GATHER_SUMS, rgba32f) uniform image2DArray sums;

// Of a single frame: no picture is brighter.
const vec3 MOST_RADIANCE = vec3(1e30);
// Bounces before a path may be ended by chance.
const uint SAFE_BOUNCES = 2u;
// Radii of half a tile within which its pixels draw the scene's own lights for themselves.
const float NEAR_TILES = 2.0;
// No bound, and no distance.
const float UNBOUNDED = 1e30;

uint random_state;
// Of the virtual lights that the pixel chooses from.
uint first_light;

float random() {
    random_state = hash(random_state);
    return unit(random_state);
}

vec2 random_pair() { return vec2(random(), random()); }

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
    return dark ? vec3(0.0) : clamp(sum, -MOST_RADIANCE, MOST_RADIANCE);
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

// One of the lights drawn for half a tile, of those not nearer than `beyond`, chosen by about what it adds unless it is hidden (Talbot et al. 2005, Importance
// Resampling for Global Illumination).
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

// Light of the scene's own lights.
vec3 own_lights(Vertex v) {
    vec3 sum = vec3(0.0);
    if (gather.points.y > 0u) sum += drawn(v, gather.points, UNBOUNDED, UNBOUNDED, 0u, ALL_AROUND);
    if (gather.emitters.y > 0u) sum += drawn(v, gather.emitters, UNBOUNDED, UNBOUNDED, 0u, WITH_NORMALS);
    return sum;
}

// Bounces are those that are left.
vec3 virtual_lights(Vertex v, bool seen, uint bounces) {
    if (gather.virtuals.y == 0u || bounces == 0u) return vec3(0.0);
    if (seen) return chosen(v, first_light, gather.virtuals, 0.0, gather.bound, bounces, WITH_NORMALS);
    return drawn(v, gather.virtuals, UNBOUNDED, gather.bound, bounces, WITH_NORMALS);
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
    float reach = GATHER_LAMBERT ? inversesqrt(gather.bound) : 1e30;
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

vec3 indirect(Vertex v) {
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    bool goes_on = true;
    for (uint bounce = 0u; bounce <= gather.bounces && goes_on; ++bounce) {
        if (bounce > 0u) radiance += throughput * own_lights(v);
        radiance += throughput * virtual_lights(v, bounce == 0u, gather.bounces - bounce);
        // Behind the last bounce there is only the background.
        goes_on = bounce < gather.bounces || frame.background != vec3(0.0);
        if (goes_on && bounce >= SAFE_BOUNCES) {
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
    // Paths with next to no probability, whose products overflow.
    radiance = mix(clamp(radiance, -MOST_RADIANCE, MOST_RADIANCE), vec3(0.0), isnan(radiance));
    imageStore(sums, texel, imageLoad(sums, texel) + vec4(radiance, 0.0));
}

// Lights for the tile's pixels: virtual lights for each half, then the scene's own.
void draw_for_tile(uint tile_seed) {
    const uint all = HALVES * GATHER_DRAWN;
    uint index = gl_LocalInvocationIndex;
    uint of_half = index % all / GATHER_DRAWN;
    bool own = index >= all;
    random_state = hash(tile_seed + index);
    float u = (float(index % GATHER_DRAWN) + random()) * (1.0 / float(GATHER_DRAWN));
    if (GATHER_INDIRECT && !own && gather.virtuals.y > 0u) {
        Lit lit = half_lit(of_half, gather.bound);
        tile_lights[index] = candidate(gather.virtuals, lit, u, random_state, WITH_NORMALS);
    }
    if (GATHER_POINTS && own && gather.points.y > 0u) {
        Lit lit = half_lit(of_half, UNBOUNDED);
        tile_lights[index] = candidate(gather.points, lit, u, random_state, ALL_AROUND);
    }
    barrier();
}

void main() {
    // Tiles lie elsewhere in each frame: pixels share lights with other neighbours.
    uint frame_seed = hash(gather.seed * GATHER_FRAMES + gather.frame);
    uvec2 shift = uvec2(frame_seed, frame_seed >> 8) % GATHER_SIDE;
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, gather.row) - shift;
    // Those left of the picture and above it wrap around to large numbers.
    bool inside = pixel.x < frame.size.x && pixel.y < frame.size.y;
    ivec2 at = inside ? ivec2(pixel) : ivec2(0);
    SeenPlace place = place_at(at);
    Cut cut = halve_tile(inside && place.exists, place.position, place.normal);
    draw_for_tile(hash(frame_seed ^ (gl_WorkGroupID.x + ((gl_WorkGroupID.y + gather.row / GATHER_SIDE) << 16))));
    if (!inside || !place.exists) return;
    Vertex seen = visible_at(at);
    random_state = hash(hash(pixel.x + (pixel.y << 16)) ^ frame_seed);
    uint of_half = half_of(cut, place.position);
    first_light = of_half * GATHER_DRAWN;
    if (GATHER_POINTS) {
        uint first = first_light + HALVES * GATHER_DRAWN;
        // What is near for its size a tile hardly draws, and some of its pixels need: these draw for themselves.
        float near = NEAR_TILES * length(half_lit(of_half, UNBOUNDED).extent);
        vec3 own = chosen(seen, first, gather.points, near, UNBOUNDED, 0u, ALL_AROUND);
        own += drawn(seen, gather.points, near, UNBOUNDED, 0u, ALL_AROUND);
        add(at, GATHER_SUBSETS + gather.subset, own);
    }
    if (GATHER_INDIRECT) add(at, gather.subset, indirect(seen));
}
