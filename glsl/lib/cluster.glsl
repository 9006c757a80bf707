// Pixel and depth to view depth, slice and world position; where a list's texel lies; which pixels a mask has.
#ifndef LIB_CLUSTER_GLSL
#define LIB_CLUSTER_GLSL

float view_depth(FrameConstants frame, float depth) {
    return (frame.view_depth.x + frame.view_depth.y * depth) / (frame.view_depth.z + frame.view_depth.w * depth);
}

// Perspective: slice 0 from the eye to slice_start, then slice_scale slices an octave, so that clusters are about as
// deep as wide. Orthographic: -slice_scale slices a metre. Clamped as float: a negative float has no defined uint.
uint slice_of(FrameConstants frame, float z) {
    float slice = frame.slice_scale > 0.0
                                        ? 1.0 + frame.slice_scale * log2(max(z, 1e-30) / frame.slice_start)
                                        : -frame.slice_scale * (z - frame.slice_start);
    return uint(clamp(slice, 0.0, float(frame.slice_count - 1u)));
}

// World position of the surface at view depth z under pixel coordinate p (centres at half-integers).
vec3 world_position(FrameConstants frame, vec2 p, float z) {
    vec3 origin = frame.ray_origin + p.x * frame.ray_origin_dx + p.y * frame.ray_origin_dy;
    vec3 direction = frame.ray_direction + p.x * frame.ray_direction_dx + p.y * frame.ray_direction_dy;
    return frame.eye + (origin + z * direction);
}

ivec3 list_texel(uint texel) {
    return ivec3(
            int(texel & ((1u << LIST_WIDTH_LOG2) - 1u)),
            int((texel >> LIST_WIDTH_LOG2) & ((1u << LIST_HEIGHT_LOG2) - 1u)),
            int(texel >> (LIST_WIDTH_LOG2 + LIST_HEIGHT_LOG2)));
}

// Leaves the lower half of a word of 2 · `width` bits behind if the n-th that is set is not in it.
void halve(uint width, inout uint word, inout uint n, inout uint at) {
    uint below = uint(bitCount(word & ((1u << width) - 1u)));
    bool is_above = n >= below;
    n -= is_above ? below : 0u;
    word >>= is_above ? width : 0u;
    at += is_above ? width : 0u;
}

// Number of the n-th bit that is set. Not a loop: lavapipe would count its iterations.
uint nth_bit(uint word, uint n) {
    uint at = 0u;
    halve(16u, word, n, at);
    halve(8u, word, n, at);
    halve(4u, word, n, at);
    halve(2u, word, n, at);
    halve(1u, word, n, at);
    return at;
}

uint nth_bit(uvec2 bits, uint n) {
    uint low = uint(bitCount(bits.x));
    return n < low ? nth_bit(bits.x, n) : 32u + nth_bit(bits.y, n - low);
}

#endif
