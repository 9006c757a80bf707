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
#include "direct/lobe.glsl"
#include "direct/moments.glsl"

layout(location = 0) out vec4 radiance;

// Error of a node at the horizon, in standard deviations of n·u among its lights. Found by simulation.
const float KINK = 0.06;
// Below this share of the cluster's light at normal incidence a pixel counts as dark: what a cluster accepts may be wrong by
// too much of it.
const float DARK = 0.1;
// Least share that errors are measured by.
const float DARKEST = 1e-3;

// Steps of all loops of a pixel at most: a cut that asks for more is given up, and the frame evaluates every light
// (Frame::give_up_cuts). lavapipe ends the loops of eight invocations after 65,535 steps all told, in silence: that too leaves
// one of the loops short of its end.
const uint MAX_STEPS = 65000u;

uint steps = 0u;
bool finished = true;

// What a pixel may be wrong by.
struct Limits {
    float node;  // irradiance at n·u = 1, of any node
    float horizon;  // irradiance, of one that the horizon cuts
};

// Of nodes that the cluster accepted: those that the horizon may cut apart from the others.
struct Far {
    vec3 above;
    vec3 across;
    float irradiance;  // of both
    float error2;  // at the horizon, sum of squares
    float count;  // of nodes that it cuts
};

// Whether the horizon may cut a node: its sphere.
bool across(Surface s, vec3 offset, float radius) {
    return abs(dot(s.world_from_local[2], offset)) < radius;
}

// Whether it lies below the horizon.
bool below(Surface s, vec3 offset, float radius) { return dot(s.world_from_local[2], offset) <= -radius; }

// Lights of a sphere deviate by half its radius.
float horizon_error(Surface s, MomentHead node, vec3 offset, float d2) {
    float inverse = inversesqrt(max(d2, TINY));
    return across(s, offset, node.radius) ? 0.5 * KINK * node.radius * inverse * (node.power * inverse * inverse) : 0.0;
}

// What lies under a node, as far as this pixel has to open it.
vec3 opened(Surface s, Lobe lobe, uint root, Limits limits) {
    vec3 sum = vec3(0.0);
    uint index = root;
    uint end = moment_head(root).skip;
    while (index < end && steps < MAX_STEPS) {
        MomentHead node = moment_head(index);
        vec3 offset = node.center - s.position;
        float d2 = dot(offset, offset);
        float error = node_error(node.power, node.radius, node.error, d2);
        bool fits = node.power == 0.0 || below(s, offset, node.radius)
                                || (node_fits(node.radius, d2, error, frame.cut_open2, limits.node)
                                        && horizon_error(s, node, offset, d2) <= limits.horizon
                                        && lobe_fits(lobe, node, offset, d2, limits.node));
        bool leaf = !fits && node.skip == index + 1u;
        if (fits) sum += reflected_node(s, index).radiance;
        uint light = leaf ? node.first : 0u;
        uint behind = leaf ? light + MOMENT_LEAF : 0u;
        steps += leaf ? MOMENT_LEAF + 1u : 1u;
        for (; light < behind; ++light) sum += reflected(s, light);
        finished = finished && light >= behind;
        index = fits || leaf ? node.skip : index + 1u;
    }
    finished = finished && index >= end;
    return sum;
}

// A node that the cluster accepted, unless the pixel's lobe has to see it opened.
bool accepted(Surface s, Lobe lobe, uint index, float limit) {
    MomentHead node = moment_head(index);
    vec3 offset = node.center - s.position;
    return lobe_fits(lobe, node, offset, dot(offset, offset), limit);
}

void add_far(inout Far far, Surface s, Lobe lobe, uint index, float limit) {
    NodeLight light = reflected_node(s, index);
    vec4 place = moment_place(index);
    bool taken = !lobe_is_narrow() || accepted(s, lobe, index, limit);
    bool through = across(s, place.xyz - s.position, place.w);
    far.above += taken && !through ? light.radiance : vec3(0.0);
    far.across += taken && through ? light.radiance : vec3(0.0);
    far.irradiance += taken ? light.irradiance : 0.0;
    far.error2 += taken ? sqr(KINK * light.horizon) : 0.0;
    far.count += taken && light.horizon > 0.0 ? 1.0 : 0.0;
}

vec3 near_leaf(Surface s, uint first) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < MOMENT_LEAF; ++i) sum += reflected(s, first + i);
    return sum;
}

// What of its cluster's nodes a pixel takes apart.
const uint REOPEN_LOBE = 0u;  // those too large for its lobe
const uint REOPEN_HORIZON = 1u;  // those that the horizon may cut, too
const uint REOPEN_ALL = 2u;

bool reopened(Surface s, Lobe lobe, uint index, Limits limits, uint mode) {
    vec4 place = moment_place(index);
    return mode == REOPEN_ALL || (mode == REOPEN_HORIZON && across(s, place.xyz - s.position, place.w))
            || !accepted(s, lobe, index, limits.node);
}

// What the pixel opens: roots, and of the nodes those that it takes apart. A loop of its own finds the next of them: lavapipe
// runs a loop's body at least once, and a walk's costs ten times a test.
vec3 opened_nodes(Surface s, Lobe lobe, Cut cut, Limits limits, uint mode) {
    uint roots = 4u * (cut.roots - cut.texel);
    uint end = 4u * (cut.leaves - cut.texel);
    uint entry = lobe_is_narrow() || mode != REOPEN_LOBE ? 0u : roots;
    vec3 sum = vec3(0.0);
    while (entry < end && steps < MAX_STEPS) {
        uint index = frame.moment_nodes;
        bool found = false;
        while (!found && entry < end) {
            index = list_indices(cut.texel + entry / 4u)[entry & 3u];
            found = entry >= roots || reopened(s, lobe, index, limits, mode);
            ++entry;
            ++steps;
        }
        // The null node where none was left.
        sum += opened(s, lobe, found ? index : frame.moment_nodes, limits);
    }
    finished = finished && entry >= end;
    return sum;
}

Far far_nodes(Surface s, Lobe lobe, Cut cut) {
    Far far = Far(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    for (uint texel = cut.texel; texel < cut.roots; ++texel) {
        uvec4 four = list_indices(texel);
        add_far(far, s, lobe, four.x, cut.limit);
        add_far(far, s, lobe, four.y, cut.limit);
        add_far(far, s, lobe, four.z, cut.limit);
        add_far(far, s, lobe, four.w, cut.limit);
    }
    return far;
}

vec3 near_leaves(Surface s, Cut cut) {
    vec3 sum = vec3(0.0);
    for (uint texel = cut.leaves; texel < cut.end; ++texel) {
        uvec4 four = list_indices(texel);
        sum += near_leaf(s, four.x);
        sum += near_leaf(s, four.y);
        sum += near_leaf(s, four.z);
        sum += near_leaf(s, four.w);
    }
    return sum;
}

// All that the cut holds, in two parts: what the cluster has decided, and what the pixel opens.
vec3 of_cut(Surface s, Lobe lobe, Cut cut) {
    Far far = far_nodes(s, lobe, cut);
    vec3 near = near_leaves(s, cut);
    // The pixel's irradiance, as far as it is known: as bright as if all came from afar.
    float nodes = luminance(far.above + far.across);
    float irradiance = far.irradiance * (1.0 + luminance(near) / max(nodes, TINY));
    float least = DARKEST * cut.power;
    float allowed = frame.cut_horizon * max(irradiance, least);
    bool dark = irradiance < DARK * cut.power;
    uint mode = dark ? REOPEN_ALL : far.error2 > sqr(allowed) ? REOPEN_HORIZON : REOPEN_LOBE;
    // Twice, for a surface that faces its lights in the mean has half their light.
    float dim = dark ? max(2.0 * irradiance, least) / max(cut.power, TINY) : 1.0;
    Limits limits = Limits(cut.limit * dim, allowed * inversesqrt(max(far.count, 1.0)));
    vec3 taken = dark ? vec3(0.0) : far.above;
    taken += mode == REOPEN_LOBE ? far.across : vec3(0.0);
    return taken + near + opened_nodes(s, lobe, cut, limits, mode);
}

void main() {
    Surface s = surface_here();
    Lobe lobe = lobe_here(s);
    Cut cut = cut_at(ivec2(gl_FragCoord.xy));
    steps = (cut.roots - cut.texel) + (1u + 4u * MOMENT_LEAF) * (cut.end - cut.leaves);
    bool holds = steps < MAX_STEPS;
    if (!holds) cut = Cut(0u, 0u, 0u, 0u, 0.0, 0.0);
    vec3 sum = of_cut(s, lobe, cut);
    radiance = vec4(min(sum, MAX_RADIANCE), holds && finished ? 0.0 : 1.0);
}
