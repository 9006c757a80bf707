// Step 3 of the order on the device, once a digit: of the counts the places where each block's elements go, by the digit's
// value first and then by the block, so that elements of one value keep their order. An invocation has a value.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "cluster/scan.glsl"
#include "order/block.glsl"

layout(set = SET_order, binding = ORDER_COUNTS, std430) buffer CountBlock { uint counts[]; };

void main() {
    uint value = gl_LocalInvocationIndex;
    uint sum = 0u;
    for (uint block = 0u; block < order.blocks; ++block) sum += counts[block * ORDER_DIGITS + value];
    uint total;
    uint place = exclusive_sum(sum, total);
    for (uint block = 0u; block < order.blocks; ++block) {
        uint count = counts[block * ORDER_DIGITS + value];
        counts[block * ORDER_DIGITS + value] = place;
        place += count;
    }
}
