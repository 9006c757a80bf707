// Indirect subpass: the many lights of the pixel's cluster, four indices a fetch.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/fragment.glsl"
#include "lib/light.glsl"
#include "bind/surface.glsl"
#include "indirect/node.glsl"

layout(location = 0) out vec4 radiance;

void main() {
    Surface surface = surface_here();
    LightList list = list_at(ivec2(gl_FragCoord.xy));
    vec3 sum = vec3(0.0);
    uint end = list.texel + (list.count + 3u) / 4u;
    for (uint texel = list.texel; texel < end; ++texel) {
        uvec4 four = list_indices(texel);
        sum += reflected(surface, four.x);
        sum += reflected(surface, four.y);
        sum += reflected(surface, four.z);
        sum += reflected(surface, four.w);
    }
    if (FOLDED) {
        for (uint i = 0u; i < list.nodes; ++i) sum += reflected_node(surface, end + i * FOLD_TEXELS);
    }
    radiance = vec4(min(sum, MAX_RADIANCE), 0.0);
}
