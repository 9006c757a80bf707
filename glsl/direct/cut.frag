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
#include "bind/fragment.glsl"
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
        float error = node_error(node.power, node.radius, node.errors, d2);
        bool fits = node.power == 0.0
                                || (node_fits(node.radius, d2, error, frame.cut_open2, limit) && lobe_fits(lobe, node, offset, d2, limit));
        bool leaf = !fits && node.skip == index + 1u;
        if (fits) sum += reflected_node(s, index);
        uint light = leaf ? node.first : 0u;
        uint behind = leaf ? light + MOMENT_LEAF : 0u;
        for (; light < behind; ++light) sum += reflected(s, light);
        index = fits || leaf ? node.skip : index + 1u;
    }
    return sum;
}

// A node that the cluster accepted, unless the pixel's lobe has to see it opened.
bool accepted(Surface s, Lobe lobe, uint index, float limit) {
    MomentHead node = moment_head(index);
    vec3 offset = node.center - s.position;
    return lobe_fits(lobe, node, offset, dot(offset, offset), limit);
}

vec3 far_node(Surface s, Lobe lobe, uint index, float limit) {
    vec3 radiance = reflected_node(s, index);
    return !lobe_is_narrow() || accepted(s, lobe, index, limit) ? radiance : vec3(0.0);
}

vec3 near_leaf(Surface s, uint first) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < MOMENT_LEAF; ++i) sum += reflected(s, first + i);
    return sum;
}

// What the pixel opens: roots, and nodes too large for its lobe. A loop of its own finds the next of them: lavapipe runs a
// loop's body at least once, and a walk's costs ten times a test.
vec3 opened_nodes(Surface s, Lobe lobe, Cut cut, float limit) {
    uint roots = 4u * (cut.roots - cut.texel);
    uint end = 4u * (cut.leaves - cut.texel);
    uint entry = lobe_is_narrow() ? 0u : roots;
    vec3 sum = vec3(0.0);
    while (entry < end) {
        uint index = frame.moment_nodes;
        bool found = false;
        while (!found && entry < end) {
            index = list_indices(cut.texel + entry / 4u)[entry & 3u];
            found = entry >= roots || !accepted(s, lobe, index, limit);
            ++entry;
        }
        // The null node where none was left.
        sum += opened(s, lobe, found ? index : frame.moment_nodes, limit);
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
        sum += far_node(s, lobe, four.x, limit);
        sum += far_node(s, lobe, four.y, limit);
        sum += far_node(s, lobe, four.z, limit);
        sum += far_node(s, lobe, four.w, limit);
    }
    for (uint texel = cut.leaves; texel < cut.end; ++texel) {
        uvec4 four = list_indices(texel);
        sum += near_leaf(s, four.x);
        sum += near_leaf(s, four.y);
        sum += near_leaf(s, four.z);
        sum += near_leaf(s, four.w);
    }
    sum += opened_nodes(s, lobe, cut, limit);
    radiance = vec4(min(sum, MAX_RADIANCE), 1.0);
}
