// Direct subpass: the area lights of the draw, see passes/direct.rs; with masks, those of them that reach the pixel's
// cluster.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/area_lights.glsl"
#include "bind/textures.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"
#include "direct/area_light.glsl"

layout(constant_id = 37) const bool LIGHT_MASKS = false;
layout(location = 0) out vec4 radiance;

void main() {
    Surface surface = surface_here();
    vec3 sum = vec3(0.0);
    if (LIGHT_MASKS) {
        uint cluster = cluster_at(ivec2(gl_FragCoord.xy));
        uint end = (draw.lights.y + 31u) >> 5;
        // Two loops, not one with a branch: Mesa 22.3.6 runs both sides of one.
        for (uint word = draw.lights.x >> 5; word < end; ++word) {
            uvec2 mask = area_mask(cluster, word);
            for (uint near = mask.x & ~mask.y; near != 0u; near &= near - 1u) {
                sum += area_reflected(surface, area_light((word << 5) + uint(findLSB(near))));
            }
        }
        for (uint word = draw.lights.x >> 5; word < end; ++word) {
            uvec2 mask = area_mask(cluster, word);
            for (uint far = mask.x & mask.y; far != 0u; far &= far - 1u) {
                sum += area_reflected_far(surface, area_light((word << 5) + uint(findLSB(far))));
            }
        }
    } else {
        for (uint i = draw.lights.x; i < draw.lights.y; ++i) sum += area_reflected(surface, area_light(i));
    }
    radiance = vec4(min(sum, MAX_RADIANCE), 1.0);
}
