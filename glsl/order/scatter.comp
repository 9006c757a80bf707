// Step 4 of the order on the device, once a digit: every element to its place. An invocation goes through a block in order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "order/block.glsl"

layout(local_size_x_id = 46) in;
layout(set = SET_order, binding = ORDER_FROM, std430) readonly buffer FromBlock { uvec2 from[]; };
layout(set = SET_order, binding = ORDER_TO, std430) writeonly buffer ToBlock { uvec2 to[]; };
layout(set = SET_order, binding = ORDER_COUNTS, std430) buffer CountBlock { uint counts[]; };

void main() {
    uint block = gl_GlobalInvocationID.x;
    if (block >= order.blocks) return;
    uint first = block * ORDER_DIGITS;
    uvec2 range = elements(block);
    for (uint i = range.x; i < range.y; ++i) {
        uvec2 element = from[i];
        uint place = counts[first + digit(element.x)]++;
        to[place] = element;
    }
}
