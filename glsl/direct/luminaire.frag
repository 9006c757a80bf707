// A light that is seen: its radiance, and black on the back of a one-sided one.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/area_lights.glsl"

layout(push_constant, std430) uniform PushBlock { DrawConstants draw; };
layout(constant_id = 35) const bool TEXTURED_LIGHTS = true;
layout(location = 3) in vec2 uv;
layout(location = 0) out vec4 radiance;

void main() {
    AreaLight light = area_light(draw.lights.x);
    vec3 emitted = light.radiance;
    if (TEXTURED_LIGHTS && light.textured) {
        vec2 size = vec2(light.width, light.height);
        vec2 across = dFdx(uv) * size;
        vec2 down = dFdy(uv) * size;
        float texels2 = max(max(dot(across, across), dot(down, down)), 1e-30);
        emitted *= area_texel(light, uv, 0.5 * log2(texels2) + frame.texture_bias);
    }
    // The back of a line is its inside, which is not drawn.
    bool shines = gl_FrontFacing || light.two_sided || light.kind == AREA_LINE;
    radiance = vec4(shines ? min(emitted, vec3(1e30)) : vec3(0.0), 0.0);
}
