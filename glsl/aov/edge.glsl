// How far the edges of a triangle are.
#ifndef AOV_EDGE_GLSL
#define AOV_EDGE_GLSL

// Where a coordinate has no slope, or none that numbers can hold: beyond any picture's edge.
const float NO_EDGE = 1e6;

// Pixels to the nearest edge: each barycentric coordinate is 0 on the edge opposite its corner. Where a neighbour that
// extrapolates is behind the eye, its slope may be anything: comparisons with what is no number are false.
float edge_distance(vec3 barycentric) {
    vec3 dx = dFdx(barycentric);
    vec3 dy = dFdy(barycentric);
    float nearest = NO_EDGE;
    for (int i = 0; i < 3; i++) {
        float pixels = max(barycentric[i], 0.0) * inversesqrt(dx[i] * dx[i] + dy[i] * dy[i]);
        if (pixels < nearest) nearest = pixels;
    }
    return nearest;
}

#endif
