// Set 1: the lights. Two RGBA32F texels a light, in Hilbert order, lights with a range first: its place in one layer, its
// power in the next, so that tests of places fetch half as much (a million lights: cluster −2 %, shading −2 %). An image, not a storage
// buffer, which lavapipe reads lane by lane; and not a texture: of a texelFetch it computes the mip level's size and place
// for each lane, 150 instructions instead of 60 (light_grid: cluster 75 → 46, fragment shading 165 → 111 CPU ms).
#ifndef BIND_LIGHTS_GLSL
#define BIND_LIGHTS_GLSL

layout(set = SET_scene, binding = SCENE_LIGHTS, rgba32f) readonly uniform image2DArray scene_lights;

ivec3 light_texel(uint index) {
    return ivec3(
            int(index & (LIGHTS_PER_ROW - 1u)),
            int((index >> LIGHTS_PER_ROW_LOG2) & ((1u << LIGHT_ROWS_LOG2) - 1u)),
            int(index >> (LIGHTS_PER_ROW_LOG2 + LIGHT_ROWS_LOG2) << 1));
}

// xyz position, w 1/range² (0 without a range).
vec4 light_place(uint index) { return imageLoad(scene_lights, light_texel(index)); }

// rgb radiant intensity, w the floor of d².
vec4 light_power(uint index) { return imageLoad(scene_lights, light_texel(index) + ivec3(0, 0, 1)); }

#endif
