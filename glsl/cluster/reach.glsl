// Which lights reach a cluster: a walk over the light tree without a stack. Each invocation walks alone, so no
// subgroup size is assumed and the lights come in Hilbert order on every device. The including shader defines
// ON_HITS(first, hits), called for each leaf: bit i of `hits` says that light first + i meets the cluster's box.
//
// lavapipe ends an invocation's loops after 65,535 iterations in all. A walk over a million lights therefore has one
// iteration a node, 37,450 at most, and none a light: a leaf's tests are unrolled.
layout(local_size_x = LINEAR_GROUP) in;
layout(set = SET_scene, binding = SCENE_LIGHT_NODES) uniform utexture2D light_nodes;

// The cluster of this invocation, row by row of the dispatch.
uint cluster_here() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * LINEAR_GROUP + gl_LocalInvocationIndex;
}

// Keeps a light whose window is 0 to the last bit rather than lose one to rounding.
const float REACH = 1.00001;

uint leaf_hits(uint first, uint count, vec3 lower, vec3 upper) {
    uint hits = 0u;
    [[unroll]] for (uint i = 0u; i < LEAF_LIGHTS; ++i) {
        vec4 place = light_place(first + i);
        vec3 to_box = max(max(lower - place.xyz, place.xyz - upper), vec3(0.0));
        hits |= uint(dot(to_box, to_box) * place.w <= REACH) << i;
    }
    // Past the leaf's end there are other lights, or zeros.
    return count == LEAF_LIGHTS ? hits : hits & ((1u << count) - 1u);
}

// A texture, not a storage buffer, for the reason given at the lights; of integers, which no device rounds.
LightNode node_at(uint index) {
    ivec2 texel = ivec2((index & ((1u << NODES_PER_ROW_LOG2) - 1u)) << 1, index >> NODES_PER_ROW_LOG2);
    uvec4 lower = texelFetch(light_nodes, texel, 0);
    uvec4 upper = texelFetch(light_nodes, texel + ivec2(1, 0), 0);
    return LightNode(uintBitsToFloat(lower.xyz), lower.w, uintBitsToFloat(upper.xyz), upper.w);
}

void visit_lights(vec3 lower, vec3 upper) {
    uint index = 0u;
    while (index < frame.node_count) {
        LightNode node = node_at(index);
        if (any(greaterThan(node.lower, upper)) || any(lessThan(node.upper, lower))) {
            index = node.skip;
            continue;
        }
        if (node.lights != 0u) {
            uint first = node.lights >> LEAF_COUNT_BITS;
            ON_HITS(first, leaf_hits(first, node.lights & ((1u << LEAF_COUNT_BITS) - 1u), lower, upper))
        }
        ++index;
    }
}
