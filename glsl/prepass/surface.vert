// The one vertex module of prepass and shading: equal depths need equal arithmetic.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;

layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec2 out_uv;

invariant gl_Position;

void main() {
    out_normal = normal;
    out_tangent = tangent;
    out_uv = uv;
    // Relative to the eye first: far from the origin the matrix would cancel.
    gl_Position = frame.clip_from_eye * vec4(position - frame.eye, 1.0);
}
