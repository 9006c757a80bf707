// Random numbers of an invocation.
#ifndef GATHER_RANDOM_GLSL
#define GATHER_RANDOM_GLSL

#include "lib/random.glsl"

uint random_state;

float random() {
    random_state = hash(random_state);
    return unit(random_state);
}

vec2 random_pair() { return vec2(random(), random()); }

#endif
