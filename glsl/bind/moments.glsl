// Set 1: the tree over lights without a range, in the texture of the light trees.
#ifndef BIND_MOMENTS_GLSL
#define BIND_MOMENTS_GLSL

layout(set = SET_scene, binding = SCENE_LIGHT_NODES) uniform utexture2D light_nodes;

ivec2 moment_texel(uint index) {
    return ivec2(
            (index & ((1u << MOMENTS_PER_ROW_LOG2) - 1u)) << MOMENT_STRIDE_LOG2,
            frame.moment_row + (index >> MOMENTS_PER_ROW_LOG2));
}

// What a walk asks of a node.
struct MomentHead {
    vec3 center;
    float radius;
    float power;
    float error;
    uint skip;
    uint first;
};

MomentHead moment_head(uint index) {
    ivec2 texel = moment_texel(index);
    vec4 place = uintBitsToFloat(texelFetch(light_nodes, texel, 0));
    uvec4 rest = texelFetch(light_nodes, texel + ivec2(1, 0), 0);
    return MomentHead(place.xyz, place.w, uintBitsToFloat(rest.x), uintBitsToFloat(rest.y), rest.z, rest.w);
}

// Centre and radius.
vec4 moment_place(uint index) { return uintBitsToFloat(texelFetch(light_nodes, moment_texel(index), 0)); }

// What shading asks of it.
struct Moments {
    vec3 center;
    vec3 intensity;
    mat3 covariance;
    mat3 shifts;  // columns: axes; rows: channels
    vec3 below;  // extents from the centre
    vec3 above;
};

vec3 tens(uint packed) {
    ivec3 bits = ivec3(
            bitfieldExtract(int(packed), 0, 10), bitfieldExtract(int(packed), 10, 10), bitfieldExtract(int(packed), 20, 10));
    return vec3(bits) / 511.0;
}

// Fetches take 2 ns each on lavapipe: that is why the shifts are packed.
Moments moments_at(uint index) {
    ivec2 texel = moment_texel(index);
    vec4 place = moment_place(index);
    uvec4 two = texelFetch(light_nodes, texel + ivec2(2, 0), 0);
    uvec4 three = texelFetch(light_nodes, texel + ivec2(3, 0), 0);
    uvec4 four = texelFetch(light_nodes, texel + ivec2(4, 0), 0);
    uvec4 five = texelFetch(light_nodes, texel + ivec2(5, 0), 0);
    vec2 x = unpackUnorm2x16(five.x);
    vec2 y = unpackUnorm2x16(five.y);
    vec2 z = unpackUnorm2x16(five.z);
    vec3 diagonal = uintBitsToFloat(two.xyz);
    vec3 mixed = uintBitsToFloat(three.xyz);
    return Moments(
            place.xyz,
            uintBitsToFloat(four.xyz),
            mat3(
                    diagonal.x, mixed.x, mixed.y,
                    mixed.x, diagonal.y, mixed.z,
                    mixed.y, mixed.z, diagonal.z),
            place.w * mat3(tens(two.w), tens(three.w), tens(four.w)),
            place.w * vec3(x.x, y.x, z.x),
            place.w * vec3(x.y, y.y, z.y));
}

#endif
