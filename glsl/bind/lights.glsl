// Set 1: the lights. Two RGBA32F texels a light, in Hilbert order, lights with a range first. A texture, not a
// storage buffer: lavapipe vectorises texel fetches (5.8 against 9.1 CPU-ns a pair).
#ifndef BIND_LIGHTS_GLSL
#define BIND_LIGHTS_GLSL

layout(set = SET_scene, binding = SCENE_LIGHTS) uniform texture2DArray scene_lights;

ivec3 light_texel(uint index) {
    return ivec3(
            int((index & (LIGHTS_PER_ROW - 1u)) << 1),
            int((index >> LIGHTS_PER_ROW_LOG2) & ((1u << LIGHT_ROWS_LOG2) - 1u)),
            int(index >> (LIGHTS_PER_ROW_LOG2 + LIGHT_ROWS_LOG2)));
}

// xyz position, w 1/range² (0 without a range).
vec4 light_place(uint index) { return texelFetch(scene_lights, light_texel(index), 0); }

// rgb radiant intensity, w the floor of d².
vec4 light_power(uint index) { return texelFetch(scene_lights, light_texel(index) + ivec3(1, 0, 0), 0); }

#endif
