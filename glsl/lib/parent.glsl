// Lists of parents: PARENT_ROOM entries, the lights that reach them; where these are more, their leaves; and where these are
// more, too, every light is tested. Elsewhere, for each SIBLINGS children, a texel for each 32 entries: bit i of component c
// says that light i of these reaches child c. Only lists of lights have such masks.
#ifndef LIB_PARENT_GLSL
#define LIB_PARENT_GLSL

// A million lights in one place would need lists of gigabytes, and masks of as much.
const uint OF_LIGHTS = 0u;
const uint OF_LEAVES = 1u;
const uint OF_ALL = 2u;

uint parent_kind(Cluster parent) { return parent.reaching >> PARENT_COUNT_BITS; }

uint parent_entries(Cluster parent) { return parent.reaching & ((1u << PARENT_COUNT_BITS) - 1u); }

// Groups of 32 lights.
uint parent_groups(Cluster parent) {
    uint entries = parent_entries(parent);
    return parent_kind(parent) == OF_LIGHTS ? (entries + LEAF_LIGHTS - 1u) / LEAF_LIGHTS : entries;
}

// Texel of the masks of a child and its siblings.
uint sibling_masks(uint child) { return frame.sibling_texels + child / SIBLINGS * (PARENT_ROOM / LEAF_LIGHTS); }

#endif
