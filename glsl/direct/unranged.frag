// Direct subpass: every point light without a range reaches every pixel; where they are few, or no error is allowed, they
// are evaluated one by one.
// The draw says which of them: see passes/direct.rs.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"
#include "bind/fragment.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"

// Of how many blocks of 4 × 4 pixels one is shaded; 0: all are.
layout(constant_id = 61) const uint ONE_IN = 0u;

layout(location = 0) out vec4 radiance;

// Multiples of the golden ratio's fraction are spread evenly, along rows and down.
bool chosen(uvec2 block) {
    if (ONE_IN == 0u) return true;
    uint number = block.y * ((frame.size.x + 3u) / 4u) + block.x;
    return number * 2654435769u <= 0xffffffffu / ONE_IN;
}

void main() {
    Surface surface = surface_here();
    bool shaded = chosen(uvec2(gl_FragCoord.xy) / 4u);
    uint end = shaded ? draw.lights.y : draw.lights.x;
    vec3 sum = vec3(0.0);
    for (uint light = draw.lights.x; light < end; ++light) sum += reflected(surface, light);
    radiance = vec4(min(sum, MAX_RADIANCE), ONE_IN != 0u && shaded ? 1.0 : 0.0);
}
