// Sums over the invocations of a small workgroup, without an assumption on subgroups. The including shader defines LANES, the
// invocations of the workgroup, and MOST_LANES where it does not know them.
#ifndef MOST_LANES
#define MOST_LANES LANES
#endif
shared uvec2 lane_values[MOST_LANES];

// Sums of the values of lower invocations, and of all.
uvec4 lane_sums(uvec2 value) {
    uint lane = gl_LocalInvocationIndex;
    barrier();
    lane_values[lane] = value;
    barrier();
    uvec4 sum = uvec4(0u);
    [[unroll]] for (uint i = 0u; i < LANES; ++i) {
        uvec2 other = lane_values[i];
        sum += uvec4(i < lane ? other : uvec2(0u), other);
    }
    return sum;
}
