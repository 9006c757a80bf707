// A light that is seen: nothing that compute shading could shade.
#version 450

layout(location = 0) out uvec4 surface;

void main() { surface = uvec4(0u); }
