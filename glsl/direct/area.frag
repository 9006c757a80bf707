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

void main() {
    Receiver receiver = receiver_here();
    vec3 sum = vec3(0.0);
    if (LIGHT_MASKS) {
        uint cluster = cluster_at(ivec2(gl_FragCoord.xy));
        uint end = (draw.lights.y + 31u) >> 5;
        for (uint word = draw.lights.x >> 5; word < end; ++word) {
            // Of the words at both ends, the lights of this draw.
            uint first = word == draw.lights.x >> 5 ? draw.lights.x & 31u : 0u;
            uint last = min(draw.lights.y - (word << 5), 32u) - 1u;
            uint mine = (0xffffffffu << first) & (0xffffffffu >> (31u - last));
            for (uint mask = area_mask(cluster, word).x & mine; mask != 0u; mask &= mask - 1u) {
                sum += area_reflected(receiver, (word << 5) + uint(findLSB(mask)));
            }
        }
    } else {
        for (uint i = draw.lights.x; i < draw.lights.y; ++i) sum += area_reflected(receiver, i);
    }
    radiance = vec4(min(sum, MAX_RADIANCE), 1.0);
}
