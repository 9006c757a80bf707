// How many lights of a list have a place within their range: the pairs that are useful.
#ifndef BIND_WITHIN_GLSL
#define BIND_WITHIN_GLSL

#include "bind/lights.glsl"
#include "bind/lists.glsl"

uint lights_within(LightList list, vec3 position) {
    uint within = 0u;
    for (uint i = 0u; i < list.count; ++i) {
        vec4 place = light_place(list_indices(list.texel + i / 4u)[i & 3u]);
        vec3 d = place.xyz - position;
        within += uint(dot(d, d) * place.w < 1.0);
    }
    return within;
}

#endif
