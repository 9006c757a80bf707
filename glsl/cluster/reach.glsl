// Which lights reach a box: the tests of lights and of nodes of their tree.
layout(set = SET_scene, binding = SCENE_LIGHT_NODES) uniform utexture2D light_nodes;

// Keeps a light whose window is 0 to the last bit rather than lose one to rounding.
const float REACH = 1.00001;

// `precise`: the steps that count and that write ask from modules of their own, and must hear the same.
bool reaches(vec4 place, vec3 lower, vec3 upper) {
    vec3 to_box = max(max(lower - place.xyz, place.xyz - upper), vec3(0.0));
    precise float d2 = to_box.x * to_box.x + to_box.y * to_box.y + to_box.z * to_box.z;
    precise float share = d2 * place.w;
    return share <= REACH;
}

// The first `count` bits.
uint first_bits(uint count) { return count >= 32u ? ~0u : (1u << count) - 1u; }

// A texture, not a storage buffer, which lavapipe reads lane by lane; of integers, which no device rounds.
LightNode node_at(uint index) {
    ivec2 texel = ivec2((index & ((1u << NODES_PER_ROW_LOG2) - 1u)) << 1, index >> NODES_PER_ROW_LOG2);
    uvec4 lower = texelFetch(light_nodes, texel, 0);
    uvec4 upper = texelFetch(light_nodes, texel + ivec2(1, 0), 0);
    return LightNode(uintBitsToFloat(lower.xyz), lower.w, uintBitsToFloat(upper.xyz), upper.w);
}

bool overlap(LightNode node, vec3 lower, vec3 upper) {
    return all(lessThanEqual(node.lower, upper)) && all(greaterThanEqual(node.upper, lower));
}

uint leaf_hits(uint first, uint count, vec3 lower, vec3 upper) {
    uint hits = 0u;
    [[unroll]] for (uint i = 0u; i < LEAF_LIGHTS; ++i) {
        hits |= uint(reaches(light_place(first + i), lower, upper)) << i;
    }
    // Past the leaf's end there are other lights, or zeros.
    return hits & first_bits(count);
}
