// 3 pixels an invocation: see many.glsl.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"

#define PIXELS 3
#include "resolve/many.glsl"
