// The lights that reach a cluster, a batch of groups after the other, in order. Each invocation knows a group's; then they
// take one light each, whichever group it is of: groups have 0 to 32 of them, and most invocations would wait for others.

const uint BATCH_GROUPS = 32u;
const uint BATCH_LIGHTS = BATCH_GROUPS * LEAF_LIGHTS;
// Tests of an iteration: lavapipe makes the first of these for parents that are not crowded, too.
const uint TESTS = 8u;

// Lights of the batch before each invocation's group; then those bits.
shared uvec4 batch_starts[MOST_LANES / 4u];
shared uvec2 batch_groups[MOST_LANES];

uint batch_step() { return min(LANES, BATCH_GROUPS); }

// Bits of the lights of a crowded parent's group that reach the cluster.
uint tested_hits(uint group) {
    uint first = leaf_of(parent, group) * LEAF_LIGHTS;
    uint hits = 0u;
    for (uint i = 0u; i < LEAF_LIGHTS; i += TESTS) {
        uint some = 0u;
        [[unroll]] for (uint j = 0u; j < TESTS; ++j) {
            some |= uint(reaches(light_place(first + i + j), here.lower, here.upper)) << j;
        }
        hits |= some << i;
    }
    return hits & first_bits(frame.direct_begin - first);
}

// Lights of a group that reach the cluster.
uint hits_of(uint id, uint group) {
    bool is_one = gl_LocalInvocationIndex < BATCH_GROUPS && group < parent_groups(parent);
    if (parent_kind(parent) == OF_LIGHTS) {
        uint hits = pick(imageLoad(light_lists, list_texel(sibling_masks(id) + group)), id % SIBLINGS);
        return is_one ? hits : 0u;
    }
    return is_one ? tested_hits(group) : 0u;
}

// Loads the batch that begins with a group; how many lights it has.
uint load_batch(uint id, uint first) {
    uint lane = gl_LocalInvocationIndex;
    uint hits = hits_of(id, first + lane);
    uvec4 sums = lane_sums(uvec2(bitCount(hits), 0u));
    batch_starts[lane / 4u][lane % 4u] = sums.x;
    batch_groups[lane] = uvec2(sums.x, hits);
    barrier();
    return sums.z;
}

// Light `i` of a batch that begins with group `first` and has `count`; the null light beyond.
uint batch_light(uint first, uint i, uint count) {
    uint lane = 0u;
    [[unroll]] for (uint k = 0u; k < LANES; k += 4u) {
        uvec4 starts = batch_starts[k / 4u];
        [[unroll]] for (uint j = 0u; j < 4u; ++j) lane += uint(starts[j] <= i);
    }
    // Of groups without a light, which begin where the next does, the last counts: it has one.
    lane -= 1u;
    uvec2 group = batch_groups[lane];
    uint slot = (first + lane) * LEAF_LIGHTS + (nth_bit(group.y, i - group.x) & 31u);
    uint kind = parent_kind(parent);
    uint entry = entry_of(parent, kind == OF_LIGHTS ? slot : slot / LEAF_LIGHTS);
    uint leaf = kind == OF_LEAVES ? entry : slot / LEAF_LIGHTS;
    uint light = kind == OF_LIGHTS ? entry : leaf * LEAF_LIGHTS + slot % LEAF_LIGHTS;
    return i < count ? light : frame.light_count;
}
