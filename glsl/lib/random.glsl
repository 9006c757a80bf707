// Numbers without order, from integers; the same on every device.
#ifndef LIB_RANDOM_GLSL
#define LIB_RANDOM_GLSL

// Jarzynski and Olano 2020, PCG-RXS-M-XS.
uint hash(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

float unit(uint x) { return float(x >> 8) * (1.0 / 16777216.0); }

// Three numbers of [0, 1): for one seed, the terms of an additive recurrence (Roberts 2018) from a random start.
vec3 spread(uint seed, uint index) {
    uint a = hash(seed);
    uint b = hash(a);
    uint c = hash(b);
    // 2³² times the inverse powers of the root of x⁴ = x + 1, in integers: no rounding after many samples.
    return vec3(unit(a + index * 3518319155u), unit(b + index * 2882110345u), unit(c + index * 2360945575u));
}

#endif
