// Set 1: the tree over lights without a range, in the texture of the light trees.
#ifndef BIND_MOMENTS_GLSL
#define BIND_MOMENTS_GLSL

layout(set = SET_scene, binding = SCENE_LIGHT_NODES) uniform utexture2D light_nodes;

ivec2 moment_texel(uint index) {
    return ivec2(
            (index & ((1u << MOMENTS_PER_ROW_LOG2) - 1u)) << MOMENT_STRIDE_LOG2,
            frame.moment_row + (index >> MOMENTS_PER_ROW_LOG2));
}

// What a walk asks of a node: its first two texels.
struct MomentHead {
    vec3 center;
    uint skip;
    float power;
    float radius;
    float kink;
    float skew;
};

MomentHead moment_head(uint index) {
    ivec2 texel = moment_texel(index);
    uvec4 place = texelFetch(light_nodes, texel, 0);
    vec4 size = uintBitsToFloat(texelFetch(light_nodes, texel + ivec2(1, 0), 0));
    return MomentHead(uintBitsToFloat(place.xyz), place.w, size.x, size.y, size.z, size.w);
}

uint moment_first(uint index) { return texelFetch(light_nodes, moment_texel(index) + ivec2(2, 0), 0).w; }

// What shading asks of it: all but the second.
struct Moments {
    vec3 center;
    vec3 intensity;
    mat3 covariance;
    mat3 shifts;  // columns: axes; rows: channels
};

Moments moments_at(uint index) {
    ivec2 texel = moment_texel(index);
    vec3 center = uintBitsToFloat(texelFetch(light_nodes, texel, 0).xyz);
    vec3 diagonal = uintBitsToFloat(texelFetch(light_nodes, texel + ivec2(2, 0), 0).xyz);
    vec4 mixed = uintBitsToFloat(texelFetch(light_nodes, texel + ivec2(3, 0), 0));
    vec4 intensity = uintBitsToFloat(texelFetch(light_nodes, texel + ivec2(4, 0), 0));
    vec4 shift_x = uintBitsToFloat(texelFetch(light_nodes, texel + ivec2(5, 0), 0));
    vec3 shift_y = uintBitsToFloat(texelFetch(light_nodes, texel + ivec2(6, 0), 0).xyz);
    return Moments(
            center,
            intensity.rgb,
            mat3(
                    diagonal.x, mixed.x, mixed.y,
                    mixed.x, diagonal.y, mixed.z,
                    mixed.y, mixed.z, diagonal.z),
            mat3(shift_x.rgb, shift_y, vec3(mixed.w, intensity.w, shift_x.w)));
}

#endif
