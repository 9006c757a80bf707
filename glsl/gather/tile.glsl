// Lights that the pixels of a tile choose from: drawn once for all of them, by what their tree's nodes may give to any.
#ifndef GATHER_TILE_GLSL
#define GATHER_TILE_GLSL

const uint ROWS = GATHER_PIXELS / GATHER_SIDE;

// A drawn light, and 1/(its probability · lights drawn).
struct Candidate {
    vec3 position;
    vec3 normal;
    float power;
    uint extra;
    uint light;
    float weight;
};

shared vec4 tile_places[GATHER_PIXELS];  // w: whether there is a surface
shared vec3 tile_normals[GATHER_PIXELS];
// Of each row: corners of the box of places, and of that of normals.
shared vec3 row_corners[ROWS][4];
shared Candidate tile_lights[2u * GATHER_DRAWN];

const float NOWHERE = 1e30;

void note_pixel(bool exists, vec3 position, vec3 normal) {
    tile_places[gl_LocalInvocationIndex] = vec4(position, exists ? 1.0 : 0.0);
    tile_normals[gl_LocalInvocationIndex] = normal;
    barrier();
    if (gl_LocalInvocationIndex < ROWS) {
        vec3 lower = vec3(NOWHERE), upper = vec3(-NOWHERE), least = vec3(2.0), most = vec3(-2.0);
        for (uint i = 0u; i < GATHER_SIDE; ++i) {
            vec4 place = tile_places[gl_LocalInvocationIndex * GATHER_SIDE + i];
            vec3 n = tile_normals[gl_LocalInvocationIndex * GATHER_SIDE + i];
            bool there = place.w > 0.0;
            lower = there ? min(lower, place.xyz) : lower;
            upper = there ? max(upper, place.xyz) : upper;
            least = there ? min(least, n) : least;
            most = there ? max(most, n) : most;
        }
        row_corners[gl_LocalInvocationIndex] = vec3[4](lower, upper, least, most);
    }
    barrier();
}

// All of the tile's pixels; a box of negative extent where there is none.
Lit tile_lit(float bound) {
    vec3 lower = vec3(NOWHERE), upper = vec3(-NOWHERE), least = vec3(2.0), most = vec3(-2.0);
    for (uint row = 0u; row < ROWS; ++row) {
        lower = min(lower, row_corners[row][0]);
        upper = max(upper, row_corners[row][1]);
        least = min(least, row_corners[row][2]);
        most = max(most, row_corners[row][3]);
    }
    vec3 middle = least + most;
    vec3 axis = dot(middle, middle) > 1e-6 ? normalize(middle) : vec3(0.0, 0.0, 1.0);
    // The box's farthest corner; rounding must not leave a normal outside.
    vec3 nearest = min(axis * least, axis * most);
    float cosine = min(nearest.x + nearest.y + nearest.z, 1.0) - 1e-6;
    vec3 extent = 0.5 * (upper - lower) + 1e-6 * max(abs(lower), abs(upper));
    return Lit(0.5 * (lower + upper), extent, axis, max(cosine, -1.0), bound);
}

// One of a tree's lights for the tile.
Candidate candidate(uvec2 tree, Lit lit, float u, uint seed, bool with_normals) {
    Drawn choice = draw_light(tree, lit, u, seed, with_normals);
    VirtualLight light = gathered_light(tree, choice.light);
    float weight = choice.probability > 0.0 ? 1.0 / (choice.probability * float(GATHER_DRAWN)) : 0.0;
    vec3 normal = with_normals ? unpack_unit(light.normal) : vec3(0.0);
    return Candidate(light.position, normal, luminance(light.color), light.extra, choice.light, weight);
}

#endif
