// The many lights of each cluster, for all of its pixels that have one variant: what glsl/indirect/many.frag does, in the
// same order, but a light that is fetched serves PIXELS pixels of an invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/pixel.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"

layout(local_size_x_id = 42) in;
layout(constant_id = 43) const uint PIXELS = RESOLVE_PIXELS;
layout(constant_id = 44) const uint RESOLVED = 0u;
layout(set = SET_resolve, binding = RESOLVE_HDR, rgba32f) uniform image2D hdr;
layout(set = SET_resolve, binding = RESOLVE_WORK, std430) readonly buffer WorkBlock {
    ResolveDispatch dispatches[RESOLVE_VARIANTS * RESOLVE_PIXELS];
    uint entries[];
};

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

    ivec2 pixels[RESOLVE_PIXELS];
    bool mine[RESOLVE_PIXELS];
    Surface surfaces[RESOLVE_PIXELS];
    vec3 sums[RESOLVE_PIXELS];
    [[unroll]] for (uint i = 0u; i < PIXELS; ++i) {
        uint index = begin + i * gl_WorkGroupSize.x;
        uint bit = nth_bit(bits, min(index, count - 1u));
        pixels[i] = corner + ivec2(bit % TILE_SIZE, bit / TILE_SIZE);
        uint variant = at_pixel(pixels[i]);
        mine[i] = index < count && variant == RESOLVED + 1u;
        surfaces[i] = surface_here();
        sums[i] = vec3(0.0);
    }
    LightList list = list_of(id);
    uint end = list.texel + (list.count + 3u) / 4u;
    for (uint texel = list.texel; texel < end; ++texel) {
        uvec4 four = list_indices(texel);
        for (uint k = 0u; k < 4u; ++k) {
            vec4 place = light_place(four[k]);
            vec4 power = light_power(four[k]);
            [[unroll]] for (uint i = 0u; i < PIXELS; ++i) sums[i] += reflected(surfaces[i], place, power);
        }
    }
    [[unroll]] for (uint i = 0u; i < PIXELS; ++i) {
        if (!mine[i]) continue;
        vec4 radiance = vec4(min(sums[i], MAX_RADIANCE), 1.0);
        imageStore(hdr, pixels[i], imageLoad(hdr, pixels[i]) + radiance);
    }
}
