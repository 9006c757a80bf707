// Direct subpass: the area lights of the draw, see passes/direct.rs; with masks, those of them that reach the pixel's
// cluster.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/area_lights.glsl"
#include "bind/fragment.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"
#include "direct/estimate.glsl"

layout(constant_id = 37) const bool LIGHT_MASKS = false;
layout(location = 0) out vec4 radiance;

// From the lights of a word's bits, the small ones first: lavapipe runs all estimators for each light of a loop that may
// need any, and points are a fraction of them.
vec3 word_reflected(Receiver receiver, uint first, uint lights) {
    vec3 sum = vec3(0.0);
    uint large = lights;
    if (!SHADOWS) {
        for (uint rest = lights; rest != 0u; rest &= rest - 1u) {
            if (small_reflected(sum, receiver, first + uint(findLSB(rest)))) large &= ~(rest & (~rest + 1u));
        }
    }
    for (; large != 0u; large &= large - 1u) sum += area_reflected(receiver, first + uint(findLSB(large)));
    return sum;
}

void main() {
    Receiver receiver = receiver_here();
    uint cluster = LIGHT_MASKS ? cluster_at(ivec2(gl_FragCoord.xy)) : 0u;
    vec3 sum = vec3(0.0);
    uint end = (draw.lights.y + 31u) >> 5;
    for (uint word = draw.lights.x >> 5; word < end; ++word) {
        // Of the words at both ends, the lights of this draw.
        uint first = word == draw.lights.x >> 5 ? draw.lights.x & 31u : 0u;
        uint last = min(draw.lights.y - (word << 5), 32u) - 1u;
        uint lights = (0xffffffffu << first) & (0xffffffffu >> (31u - last));
        if (LIGHT_MASKS) lights &= area_mask(cluster, word);
        sum += word_reflected(receiver, word << 5, lights);
    }
    radiance = vec4(min(sum, MAX_RADIANCE), 0.0);
}
