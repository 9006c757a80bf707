// Background radiance: tested for depth 0, so only where no surface is.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"

layout(location = 0) out vec4 radiance;

void main() { radiance = vec4(frame.background, 0.0); }
