// What the device cannot go below: the loop over every pixel's list with nothing but arithmetic, with nothing but fetches,
// or with both, for one surface that all pixels share. Outside the frame, for `amas bench --floors`.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "lib/light.glsl"

layout(constant_id = 0) const uint MODEL = MODEL_MATTE;
const bool ANISOTROPIC = false;
const bool ROUGH_MATTE = false;
const bool LOBE_SHEEN = false;
const bool LOBE_CLEARCOAT = false;
const bool LOBE_SUBSURFACE = false;
const bool LOBE_METALLIC = false;
#include "lib/bsdf.glsl"

// Which floor, FLOOR_*.
layout(constant_id = 43) const uint FLOOR = FLOOR_NOTHING;

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(set = SET_frame, binding = FRAME_DEPTH) uniform texture2D depth_texture;
layout(set = SET_pairs, binding = PAIRS_TILES, std430) writeonly buffer PairBlock { TilePairs pairs[]; };

shared vec3 sums[TILE_PIXELS];
shared uint counts[TILE_PIXELS];

Bsdf surface() {
    BsdfParameters p;
    p.color = vec3(0.5, 0.4, 0.3);
    p.specular = vec3(0.5);
    p.alpha_x = 0.25;
    p.alpha_y = 0.25;
    p.sigma = 0.0;
    p.eta = 1.5;
    p.metallic = 0.0;
    p.roughness = 0.5;
    p.specular_tint = 0.0;
    p.sheen = 0.0;
    p.sheen_tint = 0.0;
    p.clearcoat = 0.0;
    p.clearcoat_gloss = 0.0;
    p.subsurface = 0.0;
    return bsdf_setup(p, normalize(vec3(0.4, 0.2, 0.9)));
}

// As `reflected` of bind/surface.glsl.
vec3 one(Bsdf bsdf, vec3 position, uint light) {
    vec4 place;
    vec4 power;
    if (FLOOR == FLOOR_ARITHMETIC) {
        float f = float(light);
        place = vec4(position + vec3(0.1, 0.2, 0.3) * f, 1e-6);
        power = vec4(f, 1.0, 0.5, 1e-4);
    } else {
        place = light_place(light);
        power = light_power(light);
    }
    if (FLOOR == FLOOR_FETCH) return place.xyz + power.rgb * (place.w + power.w);
    vec3 to_light = place.xyz - position;
    float d2 = dot(to_light, to_light);
    vec3 wi = to_light * inversesqrt(max(d2, 1e-30));
    return bsdf_eval_cos(bsdf, wi) * (power.rgb * falloff(d2, place.w, power.w));
}

vec3 whole_list(ivec2 pixel, float depth) {
    Bsdf bsdf = surface();
    vec3 position = world_position(frame, vec2(pixel) + 0.5, view_depth(frame, depth));
    LightList list = list_at(pixel);
    vec3 sum = position;
    if (FLOOR == FLOOR_NOTHING) return sum + float(list.texel + list.count);
    uint end = list.texel + (list.count + 3u) / 4u;
    for (uint texel = list.texel; texel < end; ++texel) {
        uvec4 four = FLOOR == FLOOR_ARITHMETIC ? uvec4(4u * texel) + uvec4(0u, 1u, 2u, 3u) : list_indices(texel);
        sum += one(bsdf, position, four.x);
        sum += one(bsdf, position, four.y);
        sum += one(bsdf, position, four.z);
        sum += one(bsdf, position, four.w);
    }
    return sum;
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    sums[gl_LocalInvocationIndex] = vec3(0.0);
    counts[gl_LocalInvocationIndex] = 0u;
    if (all(lessThan(pixel, frame.size))) {
        float depth = texelFetch(depth_texture, ivec2(pixel), 0).r;
        if (depth > 0.0) {
            sums[gl_LocalInvocationIndex] = whole_list(ivec2(pixel), depth);
            counts[gl_LocalInvocationIndex] = list_at(ivec2(pixel)).count;
        }
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u) return;
    vec3 sum = vec3(0.0);
    uint count = 0u;
    for (uint i = 0u; i < TILE_PIXELS; ++i) {
        sum += sums[i];
        count += counts[i];
    }
    // The sum is never read; without it nothing of the loop would be left.
    uint bits = floatBitsToUint(sum.x + sum.y + sum.z);
    pairs[gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x] = TilePairs(count, bits, 0u, 0u);
}
