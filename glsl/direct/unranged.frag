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

layout(location = 0) out vec4 radiance;

void main() {
    Surface surface = surface_here();
    vec3 sum = vec3(0.0);
    for (uint light = draw.lights.x; light < draw.lights.y; ++light) sum += reflected(surface, light);
    radiance = vec4(min(sum, MAX_RADIANCE), 1.0);
}
