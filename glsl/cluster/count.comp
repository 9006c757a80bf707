// Step 5: how many lights reach each cluster.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "shared.glsl"
#include "bind/frame.glsl"
#include "bind/lights.glsl"

layout(set = SET_frame, binding = FRAME_CLUSTERS, std430) buffer ClusterBlock { Cluster clusters[]; };
layout(set = SET_frame, binding = FRAME_COUNTERS, std430) readonly buffer CounterBlock { Counters counters; };

uint reaching = 0u;
#define ON_HITS(first, hits) reaching += uint(bitCount(hits));
#include "cluster/reach.glsl"

void main() {
    uint id = cluster_here();
    if (id >= min(counters.clusters, frame.cluster_capacity)) return;
    visit_lights(clusters[id].lower, clusters[id].upper);
    clusters[id].reaching = reaching;
}
