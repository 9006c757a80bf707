// Light that comes by way of other surfaces, and that of lights whose shadows are wanted: per pixel one light of each tree,
// chosen among some that were drawn for its tile, and a path as far as that light leaves it something to find. The mean over
// frames is that of all paths from the eye.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"

layout(local_size_x = GATHER_SIDE, local_size_y = GATHER_SIDE) in;
layout(constant_id = 55) const bool GATHER_POINTS = true;
layout(constant_id = 56) const bool GATHER_INDIRECT = true;
layout(push_constant, std430) uniform PushBlock { GatherConstants gather; };
layout(set = SET_gather, binding = GATHER_SUMS, rgba32f) uniform image2DArray sums;

// Of the lights drawn for the tile, where those begin that the pixel chooses from.
uint first_light;

#include "gather/path.glsl"
#include "gather/visible.glsl"

// Radii of half a tile within which its pixels draw the scene's own lights for themselves.
const float NEAR_TILES = 2.0;
// Radii of half a tile within which paths take over from virtual lights. In scenes/indirect.toml at 96 x 72 pixels, and with the
// tree before this one, this left .80 to .87 of the variance of 65,536 lights for 1.13 times the cost; 16,384 hardly notice.
const float PATH_TILES = 4.0;

// Rounds take turns at the subsets; indirect light comes first.
void add(ivec2 pixel, uint first_layer, vec3 radiance) {
    ivec3 texel = ivec3(pixel, first_layer + gather.index / GATHER_FRAMES % GATHER_SUBSETS);
    // Paths with next to no probability, whose products overflow.
    radiance = clamp(mix(radiance, vec3(0.0), no_number(radiance)), -MAX_RADIANCE, MAX_RADIANCE);
    imageStore(sums, texel, imageLoad(sums, texel) + vec4(radiance, 0.0));
}

// Largest geometry term that virtual lights are gathered with: of what is near for its size a half hardly draws what each
// of its pixels needs, and paths find it.
float half_bound(uint of_half) {
    float near = PATH_TILES * length(half_lit(of_half, UNBOUNDED).extent);
    return min(gather.bound, 1.0 / max(sqr(near), 1e-30));
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
        Lit lit = half_lit(of_half, half_bound(of_half));
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
    uint frame_seed = hash(gather.index);
    uvec2 shift = uvec2(frame_seed, frame_seed >> 8) % GATHER_SIDE;
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, gather.row) - shift;
    // Those left of the picture and above it wrap around to large numbers.
    bool inside = pixel.x < frame.size.x && pixel.y < frame.size.y;
    ivec2 at = inside ? ivec2(pixel) : ivec2(0);
    SeenPlace place = place_at(at);
    Cut cut = halve_tile(inside && place.exists, place.position, place.normal);
    draw_for_tile(hash(frame_seed ^ (gl_WorkGroupID.x + ((gl_WorkGroupID.y + gather.row / GATHER_SIDE) << 16))));
    if (!inside || !place.exists) return;
    float bound = half_bound(half_of(cut, place.position));
    Vertex seen = visible_at(at, bound);
    random_state = hash(hash(pixel.x + (pixel.y << 16)) ^ frame_seed);
    uint of_half = half_of(cut, place.position);
    first_light = of_half * GATHER_DRAWN;
    if (GATHER_POINTS) {
        uint first = first_light + HALVES * GATHER_DRAWN;
        // What is near for its size a tile hardly draws, and some of its pixels need: these draw for themselves.
        float near = NEAR_TILES * length(half_lit(of_half, UNBOUNDED).extent);
        vec3 own = chosen(seen, first, gather.points, near, UNBOUNDED, 0u, ALL_AROUND);
        own += drawn(seen, gather.points, near, UNBOUNDED, 0u, ALL_AROUND);
        add(at, GATHER_INDIRECT ? GATHER_SUBSETS : 0u, own);
    }
    if (GATHER_INDIRECT) add(at, 0u, indirect(seen));
}
