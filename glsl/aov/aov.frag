// One arbitrary output variable, chosen by specialisation.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/textures.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"

layout(constant_id = 11) const uint AOV = AOV_POSITION;
layout(location = 0) out vec4 value;

void main() {
    if (AOV == AOV_POSITION) {
        value = vec4(surface_position(), 1.0);
    } else if (AOV == AOV_NORMAL) {
        value = vec4(shading_frame(view_direction())[2], 1.0);
    } else if (AOV == AOV_MATERIAL) {
        value = vec4(vec3(float(draw.material)), 1.0);
    } else if (AOV == AOV_LIGHT_COUNT) {
        ivec2 pixel = ivec2(gl_FragCoord.xy);
        value = vec4(vec3(float(list_at(pixel).count + unranged_count(pixel) + area_count(pixel))), 1.0);
    } else {
        value = vec4(1.0);
    }
}
