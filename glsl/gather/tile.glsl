// Lights that the pixels of half a tile choose from: drawn once for all of them, by what their tree's nodes may give to any.
// A tile is halved across its longest side in space: where it shows two surfaces, near and far, they come apart.
#ifndef GATHER_TILE_GLSL
#define GATHER_TILE_GLSL

#include "gather/trees.glsl"

const uint ROWS = GATHER_PIXELS / GATHER_SIDE;
const uint HALVES = 2u;

// A drawn light, and 1/(its probability · lights drawn).
struct Candidate {
    vec3 position;
    vec3 normal;
    float power;
    uint extra;
    uint light;
    float weight;
};

// Boxes of places and of normals; of nothing, upside down.
struct Bounds {
    vec3 lower;
    vec3 upper;
    vec3 least;
    vec3 most;
};

shared vec4 tile_places[GATHER_PIXELS];  // w: whether there is a surface
shared vec3 tile_normals[GATHER_PIXELS];
shared Bounds tile_rows[HALVES * ROWS];
shared Candidate tile_lights[2u * HALVES * GATHER_DRAWN];

const Bounds NOTHING = Bounds(vec3(1e30), vec3(-1e30), vec3(2.0), vec3(-2.0));

Bounds with(Bounds a, Bounds b) {
    return Bounds(min(a.lower, b.lower), max(a.upper, b.upper), min(a.least, b.least), max(a.most, b.most));
}

// The plane that halves the tile: an axis, and where.
struct Cut {
    vec3 axis;
    float at;
};

uint half_of(Cut cut, vec3 place) { return dot(cut.axis, place) < cut.at ? 0u : 1u; }

// A row's pixels in one half, or in both.
Bounds of_row(uint row, Cut cut, uint wanted) {
    Bounds bounds = NOTHING;
    for (uint i = row * GATHER_SIDE; i < (row + 1u) * GATHER_SIDE; ++i) {
        vec4 place = tile_places[i];
        vec3 n = tile_normals[i];
        bool there = place.w > 0.0 && (wanted == HALVES || half_of(cut, place.xyz) == wanted);
        if (there) bounds = with(bounds, Bounds(place.xyz, place.xyz, n, n));
    }
    return bounds;
}

Bounds of_rows(uint first) {
    Bounds bounds = tile_rows[first];
    for (uint row = 1u; row < ROWS; ++row) bounds = with(bounds, tile_rows[first + row]);
    return bounds;
}

// Notes the pixels of a tile; where it is halved.
Cut halve_tile(bool exists, vec3 position, vec3 normal) {
    uint index = gl_LocalInvocationIndex;
    tile_places[index] = vec4(position, exists ? 1.0 : 0.0);
    tile_normals[index] = normal;
    barrier();
    Cut cut = Cut(vec3(0.0), 0.0);
    if (index < ROWS) tile_rows[index] = of_row(index, cut, HALVES);
    barrier();
    Bounds all = of_rows(0u);
    barrier();
    vec3 size = all.upper - all.lower;
    cut.axis = vec3(equal(size, vec3(greatest(size))));
    // One of them where two are as long.
    cut.axis = cut.axis.x > 0.0 ? vec3(1.0, 0.0, 0.0) : cut.axis.y > 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    cut.at = 0.5 * dot(cut.axis, all.lower + all.upper);
    if (index < HALVES * ROWS) tile_rows[index] = of_row(index % ROWS, cut, index / ROWS);
    barrier();
    return cut;
}

// All pixels of a half; a box of negative extent where there is none.
Lit half_lit(uint of_half, float bound) {
    Bounds b = of_rows(of_half * ROWS);
    vec3 middle = b.least + b.most;
    vec3 axis = dot(middle, middle) > 1e-6 ? normalize(middle) : vec3(0.0, 0.0, 1.0);
    // The box's farthest corner; rounding must not leave a normal outside.
    vec3 nearest = min(axis * b.least, axis * b.most);
    float cosine = min(nearest.x + nearest.y + nearest.z, 1.0) - 1e-6;
    vec3 extent = 0.5 * (b.upper - b.lower) + 1e-6 * max(abs(b.lower), abs(b.upper));
    return Lit(0.5 * (b.lower + b.upper), extent, axis, max(cosine, -1.0), bound);
}

// One of a tree's lights for a half.
Candidate candidate(uvec2 tree, Lit lit, float u, uint seed, bool with_normals) {
    Drawn choice = draw_light(tree, lit, u, seed, with_normals);
    VirtualLight light = gathered_light(tree, choice.light);
    float weight = choice.probability > 0.0 ? 1.0 / (choice.probability * float(GATHER_DRAWN)) : 0.0;
    vec3 normal = with_normals ? unpack_unit(light.normal) : vec3(0.0);
    return Candidate(light.position, normal, greatest(light.color), light.extra, choice.light, weight);
}

#endif
