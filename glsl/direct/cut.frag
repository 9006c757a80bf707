// Direct subpass: point lights without a range through the cluster's cut. What is near is evaluated light by light, what is
// far node by node, and what is far but mirrored in a narrow lobe is opened until it is small against the lobe.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "lib/cluster.glsl"
#include "bind/lists.glsl"
#include "bind/lights.glsl"
#include "bind/moments.glsl"
#include "bind/textures.glsl"
#include "lib/light.glsl"
#include "lib/cut.glsl"
#include "bind/surface.glsl"
#include "direct/moments.glsl"
#include "direct/lobe.glsl"

layout(location = 0) out vec4 radiance;

// What lies under a node, as far as this pixel has to open it.
vec3 opened(Surface s, Lobe lobe, uint root, float limit) {
    vec3 sum = vec3(0.0);
    uint index = root;
    uint end = moment_head(root).skip;
    while (index < end) {
        MomentHead node = moment_head(index);
        vec3 offset = node.center - s.position;
        float d2 = dot(offset, offset);
        float error = node_error(node.power, node.radius, node.kink, node.skew, d2);
        bool fits = node.power == 0.0
                                || (node_fits(node.radius, d2, error, frame.cut_open2, limit) && lobe_fits(lobe, offset, d2, node.radius));
        bool leaf = !fits && node.skip == index + 1u;
        if (fits) sum += reflected_node(s, index);
        uint light = leaf ? moment_first(index) : 0u;
        uint behind = leaf ? light + MOMENT_LEAF : 0u;
        for (; light < behind; ++light) sum += reflected(s, light);
        index = fits || leaf ? node.skip : index + 1u;
    }
    return sum;
}

vec3 opened_four(Surface s, Lobe lobe, uvec4 four, float limit) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 4u; ++i) {
        sum += opened(s, lobe, four.x, limit);
        four = four.yzwx;
    }
    return sum;
}

void main() {
    Surface s = surface_here();
    Lobe lobe = lobe_here(s);
    Cut cut = cut_at(ivec2(gl_FragCoord.xy));
    float limit = frame.cut_share * cut.power;
    vec3 sum = vec3(0.0);
    for (uint texel = cut.texel; texel < cut.roots; ++texel) {
        uvec4 four = list_indices(texel);
        if (lobe_is_narrow()) {
            sum += opened_four(s, lobe, four, limit);
        } else {
            sum += reflected_node(s, four.x);
            sum += reflected_node(s, four.y);
            sum += reflected_node(s, four.z);
            sum += reflected_node(s, four.w);
        }
    }
    for (uint texel = cut.roots; texel < cut.leaves; ++texel) {
        sum += opened_four(s, lobe, list_indices(texel), limit);
    }
    for (uint texel = cut.leaves; texel < cut.end; ++texel) {
        uvec4 four = list_indices(texel);
        for (uint i = 0u; i < 4u * MOMENT_LEAF; ++i) {
            sum += reflected(s, four.x + (i & (MOMENT_LEAF - 1u)));
            if ((i & (MOMENT_LEAF - 1u)) == MOMENT_LEAF - 1u) four = four.yzwx;
        }
    }
    radiance = vec4(min(sum, MAX_RADIANCE), 1.0);
}
