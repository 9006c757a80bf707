// Outlines of the probe of area lights' formulas.
#ifndef PROBE_HARD_AREA_SHAPES_GLSL
#define PROBE_HARD_AREA_SHAPES_GLSL

const uint RING_VERTICES = 6u;

struct Ring {
    uint count;
    vec3 vertices[RING_VERTICES];
};

Ring ring_of(vec3 a, vec3 b, vec3 c, vec3 d) { return Ring(4u, vec3[](a, b, c, d, a, a)); }

Ring quadrilateral(HardProbeRow r) { return ring_of(r.a.xyz, r.b.xyz, r.c.xyz, r.d.xyz); }

// From corner i to the middles of its edges and of all: exact where the corners have bits to spare.
Ring quarter(HardProbeRow r, uint i) {
    vec3 corners[4] = vec3[](r.a.xyz, r.b.xyz, r.c.xyz, r.d.xyz);
    vec3 corner = corners[i], next = corners[(i + 1u) & 3u], last = corners[(i + 3u) & 3u];
    vec3 middle = 0.25 * (r.a.xyz + r.b.xyz + r.c.xyz + r.d.xyz);
    return ring_of(corner, 0.5 * (corner + next), middle, 0.5 * (corner + last));
}

// A parallelogram of center a and half axes b and c that lacks a quarter.
Ring notched(HardProbeRow r) {
    vec3 p = r.a.xyz, u = r.b.xyz, v = r.c.xyz;
    return Ring(6u, vec3[](p - u - v, p + u - v, p + u, p, p + v, p - u + v));
}

Ring parallelogram(HardProbeRow r, float size) {
    vec3 u = size * r.b.xyz, v = size * r.c.xyz;
    return ring_of(r.a.xyz - u - v, r.a.xyz + u - v, r.a.xyz + u + v, r.a.xyz - u + v);
}

// Lid and walls of the cube from −1 to 1 over the surface, seen from inside.
Ring cube_side(uint i) {
    if (i == 4u) return ring_of(vec3(1, 1, 1), vec3(1, -1, 1), vec3(-1, -1, 1), vec3(-1, 1, 1));
    vec2 out_vector = i == 0u ? vec2(1, 0) : i == 1u ? vec2(0, 1) : i == 2u ? vec2(-1, 0) : vec2(0, -1);
    vec2 along = vec2(-out_vector.y, out_vector.x);
    vec2 a = out_vector - along, b = out_vector + along;
    return ring_of(vec3(a, 0), vec3(a, 1), vec3(b, 1), vec3(b, 0));
}

Ring mapped(mat3 m, Ring ring) {
    for (uint i = 0u; i < RING_VERTICES; ++i) ring.vertices[i] = m * ring.vertices[i];
    return ring;
}

#endif
