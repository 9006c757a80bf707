// Sums over the invocations of a small workgroup, without an assumption on subgroups. The including shader defines LANES, the
// invocations of the workgroup, a multiple of 4, and MOST_LANES, the most that they may be.
//
// lavapipe reads shared memory lane by lane, but all components of a vector at once.
shared uvec4 lane_values[MOST_LANES / 4u];

// Sums of the values of lower invocations, and of all; these fit in 16 bits.
uvec4 lane_sums(uvec2 value) {
    uint lane = gl_LocalInvocationIndex;
    barrier();
    lane_values[lane / 4u][lane % 4u] = value.x | value.y << 16;
    barrier();
    uint below = 0u;
    uint all = 0u;
    [[unroll]] for (uint i = 0u; i < LANES; i += 4u) {
        uvec4 four = lane_values[i / 4u];
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            below += i + j < lane ? four[j] : 0u;
            all += four[j];
        }
    }
    return uvec4(below & 0xffffu, below >> 16, all & 0xffffu, all >> 16);
}
