// The many lights of each cluster, for all of its pixels that have one variant: what glsl/indirect/many.frag does, in the
// same order, but a light that is fetched serves PIXELS pixels of an invocation. The including shader defines PIXELS, 1 to
// RESOLVE_PIXELS, and EACH repeats a step for them: lavapipe keeps arrays that a loop indexes in memory, which made a
// light 1.6 times as dear (light_grid, resolve: 57 CPU ms, by hand 36).
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/pixel.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"
#include "indirect/node.glsl"

layout(local_size_x_id = 46) in;
layout(constant_id = 44) const uint RESOLVED = 0u;
// Read as an image too, for the reason given at the lights.
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) readonly uniform uimage2DArray list_image;
layout(set = SET_resolve, binding = RESOLVE_HDR, rgba32f) uniform image2D hdr;
layout(set = SET_resolve, binding = RESOLVE_WORK, std430) readonly buffer WorkBlock {
    ResolveDispatch dispatches[RESOLVE_VARIANTS * RESOLVE_PIXELS];
    uint entries[];
};

#if PIXELS == 1
#define EACH(STEP) STEP(0u)
#elif PIXELS == 2
#define EACH(STEP) STEP(0u) STEP(1u)
#elif PIXELS == 3
#define EACH(STEP) STEP(0u) STEP(1u) STEP(2u)
#else
#define EACH(STEP) STEP(0u) STEP(1u) STEP(2u) STEP(3u)
#endif

// Number of the n-th bit that is set.
uint nth_bit(uvec2 bits, uint n) {
    uint low = uint(bitCount(bits.x));
    uint word = n < low ? bits.x : bits.y;
    uint at = n < low ? 0u : 32u;
    n -= n < low ? 0u : low;
    [[unroll]] for (uint width = 16u; width > 0u; width >>= 1) {
        uint below = uint(bitCount(word & ((1u << width) - 1u)));
        uint skip = n >= below ? width : 0u;
        n -= n >= below ? below : 0u;
        word >>= skip;
        at += skip;
    }
    return at;
}

void main() {
    ResolveDispatch work = dispatches[RESOLVED * RESOLVE_PIXELS + PIXELS - 1u];
    uint group = gl_WorkGroupID.y * MAX_GROUPS + gl_WorkGroupID.x;
    if (group >= work.count) return;
    uint entry = entries[work.first + group];
    uint id = entry & ~RESOLVE_SECOND;
    uvec2 bits = clusters[id].pixels;
    uint tile = clusters[id].tile;
    uint count = uint(bitCount(bits.x) + bitCount(bits.y));
    uint begin = gl_LocalInvocationIndex;
    // The second entry of r rows begins behind the first, which has as many or one more.
    if (entry != id) {
        uint rows = (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
        begin += (rows - PIXELS) * gl_WorkGroupSize.x;
    }
    ivec2 corner = ivec2(tile % frame.tiles.x, tile / frame.tiles.x) * int(TILE_SIZE);

    ivec2 pixels[PIXELS];
    bool mine[PIXELS];
    Surface surfaces[PIXELS];
    vec3 sums[PIXELS];
#define SET_UP(i) { \
        uint index = begin + i * gl_WorkGroupSize.x; \
        uint bit = nth_bit(bits, min(index, count - 1u)); \
        pixels[i] = corner + ivec2(bit % TILE_SIZE, bit / TILE_SIZE); \
        uint variant = at_pixel(pixels[i]); \
        mine[i] = index < count && variant == RESOLVED + 1u; \
        surfaces[i] = surface_here(); \
        sums[i] = vec3(0.0); \
    }
    EACH(SET_UP)
    LightList list = list_of(id);
    uint end = list.texel + (list.count + 3u) / 4u;
    for (uint texel = list.texel; texel < end; ++texel) {
        uvec4 four = imageLoad(list_image, list_texel(texel));
        for (uint k = 0u; k < 4u; ++k) {
            uint light = k == 0u ? four.x : k == 1u ? four.y : k == 2u ? four.z : four.w;
            vec4 place = light_place(light);
            vec4 power = light_power(light);
#define LIGHT(i) sums[i] += reflected(surfaces[i], place, power);
            EACH(LIGHT)
        }
    }
    if (FOLDED) {
        for (uint node = 0u; node < list.nodes; ++node) {
            uint texel = end + node * FOLD_TEXELS;
#define NODE(i) sums[i] += reflected_node(surfaces[i], texel);
            EACH(NODE)
        }
    }
#define STORE(i) if (mine[i]) { \
        vec4 radiance = vec4(min(sums[i], MAX_RADIANCE), 0.0); \
        imageStore(hdr, pixels[i], imageLoad(hdr, pixels[i]) + radiance); \
    }
    EACH(STORE)
}
