// The lights of a parent's list, read back by the steps that write lists: as an image, for the reason given at the lights.
layout(set = SET_frame, binding = FRAME_LISTS_OUT, rgba32ui) uniform uimage2DArray light_lists;

// Selects, not values[i]: a dynamic index would put the vector in memory.
uint pick(uvec4 values, uint i) {
    return i == 0u ? values.x : i == 1u ? values.y : i == 2u ? values.z : values.w;
}

// Of a list of lights or leaves.
uint entry_of(Cluster parent, uint i) { return pick(imageLoad(light_lists, list_texel(parent.list + i / 4u)), i & 3u); }

// Of a crowded parent: group `group`.
uint leaf_of(Cluster parent, uint group) { return parent_kind(parent) == OF_ALL ? group : entry_of(parent, group); }

// Bits of the lights of a crowded parent's group that reach a box.
uint crowd_hits(Cluster parent, uint group, vec3 lower, vec3 upper) {
    uint first = leaf_of(parent, group) * LEAF_LIGHTS;
    return leaf_hits(first, frame.direct_begin - first, lower, upper);
}
