// Step 2 of the order on the device, once a digit: how many elements of each block have each of its values. An invocation
// goes through a block alone, so that its counters need no atomics.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "order/block.glsl"

layout(local_size_x_id = 46) in;
layout(set = SET_order, binding = ORDER_FROM, std430) readonly buffer FromBlock { uvec2 from[]; };
layout(set = SET_order, binding = ORDER_COUNTS, std430) buffer CountBlock { uint counts[]; };

void main() {
    uint block = gl_GlobalInvocationID.x;
    if (block >= order.blocks) return;
    uint first = block * ORDER_DIGITS;
    for (uint i = 0u; i < ORDER_DIGITS; ++i) counts[first + i] = 0u;
    uvec2 range = elements(block);
    for (uint i = range.x; i < range.y; ++i) ++counts[first + digit(from[i].x)];
}
