// An invocation's share of the points that are put in order.
#ifndef ORDER_BLOCK_GLSL
#define ORDER_BLOCK_GLSL

layout(push_constant) uniform Push { OrderConstants order; };

// First element of a block, and the one behind its last.
uvec2 elements(uint block) { return min(uvec2(block, block + 1u) * ORDER_BLOCK, order.count); }

// The digit of a key that this pass sorts by.
uint digit(uint key) { return key >> order.shift & (ORDER_DIGITS - 1u); }

#endif
