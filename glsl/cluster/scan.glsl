// Exclusive prefix sum over the 256 invocations of the one workgroup that scans. Each invocation sums a contiguous
// chunk first, so two barriers a doubling step suffice for any length, and the order never depends on timing.
#ifndef CLUSTER_SCAN_GLSL
#define CLUSTER_SCAN_GLSL

layout(local_size_x = SCAN_GROUP) in;

shared uint partial[SCAN_GROUP];

// Sum of the values of all lower invocations; `total` is the sum of all.
uint exclusive_sum(uint value, out uint total) {
    uint lane = gl_LocalInvocationIndex;
    partial[lane] = value;
    barrier();
    for (uint step = 1u; step < SCAN_GROUP; step <<= 1) {
        uint lower = lane >= step ? partial[lane - step] : 0u;
        barrier();
        partial[lane] += lower;
        barrier();
    }
    total = partial[SCAN_GROUP - 1u];
    return partial[lane] - value;
}

// This invocation's chunk of `count` elements.
uvec2 chunk(uint count) {
    uint each = (count + SCAN_GROUP - 1u) / SCAN_GROUP;
    uint begin = min(gl_LocalInvocationIndex * each, count);
    return uvec2(begin, min(begin + each, count));
}

#endif
