// Step 1 of the order on the device: each point's place along the Hilbert curve, by the table of src/hilbert/curve.rs. Though
// lavapipe reads it lane by lane, that takes 14 CPU ms of 2²⁰ points, where Skilling's arithmetic takes 22, level by level or unrolled.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "order/block.glsl"

layout(local_size_x = LINEAR_GROUP) in;
layout(set = SET_order, binding = ORDER_POINTS, std430) readonly buffer PointBlock { vec4 points[]; };
layout(set = SET_order, binding = ORDER_TO, std430) writeonly buffer ToBlock { uvec2 to[]; };
// Two entries a word.
layout(set = SET_order, binding = ORDER_FROM, std430) readonly buffer StepBlock { uint steps[]; };

// The point's cell along each axis; `precise`, for the host's bits.
uvec3 cell(vec3 point) {
    precise vec3 place = max((point - order.lower) * order.scale - 0.5, vec3(0.0)) + 8388608.0;
    return floatBitsToUint(place) & ((1u << HILBERT_BITS) - 1u);
}

// The last six bits, three at a time, nine bits apart.
uint threes(uint v) {
    v &= 63u;
    return (v | v << 6u) & 0xe07u;
}

// Three levels: next state << 9 | bits of the key, for a state << 9 | octants.
uint three_levels(uint state, uint octants) {
    uint entry = state << 9u | octants & 511u;
    return steps[entry >> 1u] >> 16u * (entry & 1u) & 0xffffu;
}

uint key(uvec3 v) {
    uint high = threes(v.x >> 6u) << 6u | threes(v.y >> 6u) << 3u | threes(v.z >> 6u);
    uint low = threes(v.x) << 6u | threes(v.y) << 3u | threes(v.z);
    uint a = three_levels(0u, high >> 9u);
    uint b = three_levels(a >> 9u, high);
    uint c = three_levels(b >> 9u, low >> 9u);
    uint d = three_levels(c >> 9u, low);
    // The first 32 bits of 36.
    return (a & 511u) << 23u | (b & 511u) << 14u | (c & 511u) << 5u | (d & 511u) >> 4u;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < order.count) to[index] = uvec2(key(cell(points[index].xyz)), index);
}
