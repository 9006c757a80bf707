// Step 11: how much light without a range each cluster receives, and how large a cut of the tree is within the error.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/moments.glsl"
#include "lib/math.glsl"
#include "lib/cut.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };

uint nodes = 0u;
uint roots = 0u;
uint leaves = 0u;
float errors2 = 0.0;  // of the limit's square
float inverse_limit = 0.0;
#define ON_NODE(index, error) ++nodes; errors2 += sqr(error * inverse_limit);
#define ON_ROOT(index) ++roots;
#define ON_LEAF(first) ++leaves;
#include "cluster/cut.glsl"

// A cut of fewer entries, as lights far away have, is made again with this part of the limit: what few nodes err by does not
// average out, neither among them nor over the picture.
const uint FEW = 100u;
const float OF_FEW = 0.25;

bool count_cut(vec3 lower, vec3 upper, float limit, inout uint visits) {
    nodes = 0u;
    roots = 0u;
    leaves = 0u;
    errors2 = 0.0;
    inverse_limit = limit > 0.0 ? 1.0 / limit : 0.0;
    return cut(lower, upper, limit, visits);
}

void main() {
    uint id = cluster_here();
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    uvec2 pixels = clusters[id].pixels;
    clusters[id].pixel_count = uint(bitCount(pixels.x) + bitCount(pixels.y));
    // A number that no cluster took.
    if ((pixels.x | pixels.y) == 0u) return;
    vec3 lower = clusters[id].lower;
    vec3 upper = clusters[id].upper;
    uint visits = 0u;
    float light = light_at(lower, upper, visits);
    float limit = frame.cut_share * light;
    bool ended = count_cut(lower, upper, limit, visits);
    float scale = 1.0;
    if (ended && nodes + roots + leaves < FEW) {
        scale = OF_FEW;
        limit *= OF_FEW;
        ended = count_cut(lower, upper, limit, visits);
    }
    if (!ended) {
        nodes = 0u;
        roots = 1u;
        leaves = 0u;
    }
    clusters[id].cut_nodes = nodes;
    clusters[id].cut_roots = roots;
    clusters[id].cut_leaves = leaves;
    clusters[id].cut_power = light;
    clusters[id].cut_limit = limit;
    clusters[id].cut_error = frame.cut_share * scale * sqrt(errors2);
}
