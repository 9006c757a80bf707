// One arbitrary output variable of a light that is seen. It has no material: -1. Of what surfaces in clusters reflect, it
// has as much as a pixel without one.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "aov/edge.glsl"

layout(constant_id = 11) const uint AOV = AOV_POSITION;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 value;

void main() {
    if (AOV == AOV_POSITION) {
        value = vec4(world_position(frame, gl_FragCoord.xy, view_depth(frame, gl_FragCoord.z)), 1.0);
    } else if (AOV == AOV_NORMAL) {
        value = vec4(normalize(gl_FrontFacing ? normal : -normal), 1.0);
    } else if (AOV == AOV_MATERIAL) {
        value = vec4(vec3(-1.0), 1.0);
    } else if (AOV == AOV_DEPTH) {
        value = vec4(vec3(view_depth(frame, gl_FragCoord.z)), 1.0);
    } else if (AOV == AOV_WIREFRAME) {
        value = vec4(vec3(edge_distance(normal)), 1.0);
    } else if (AOV == AOV_COVERAGE) {
        value = vec4(1.0);
    } else {
        value = vec4(0.0);
    }
}
