// The directions in which a light is seen, as a convex cone: a flat or spherical polygon of few vertices, or an ellipse.
// In polar coordinates around +z of any linear image of space the cone is an interval of cosθ for every azimuth.
#ifndef LIB_AREA_CONE_GLSL
#define LIB_AREA_CONE_GLSL

#include "lib/math.glsl"
#include "lib/area/proxy.glsl"

// A convex piece of a polygon, and one more vertex where the horizon cuts it.
const uint CONE_VERTICES = 9u;

// Vertices relative to the shaded point, in local coordinates, above the horizon; and the inward normals of the planes
// through the point and each edge. A plane follows a linear map by the transposed inverse: no vertex is mapped for it.
struct Cone {
    uint count;
    vec3 vertices[CONE_VERTICES];
    vec3 planes[CONE_VERTICES];
};

Cone cone_begin() {
    Cone cone;
    cone.count = 0u;
    return cone;
}

void cone_push(inout Cone cone, vec3 v) {
    if (cone.count < CONE_VERTICES) cone.vertices[cone.count++] = v;
}

// The edge from a to b, cut to z ≥ 0: pushes a where it is above, and the point where the edge crosses the horizon.
void cone_edge(inout Cone cone, vec3 a, vec3 b) {
    if (a.z >= 0.0) cone_push(cone, a);
    if ((a.z >= 0.0) != (b.z >= 0.0)) cone_push(cone, vec3(mix(a.xy, b.xy, a.z / (a.z - b.z)), 0.0));
}

// Planes from vertices; `turn` is −1 for a polygon that is clockwise as seen. Edges of no length bound nothing.
void cone_close(inout Cone cone, float turn) {
    for (uint i = 0u; i < cone.count; ++i) {
        vec3 a = cone.vertices[i];
        vec3 b = cone.vertices[i + 1u < cone.count ? i + 1u : 0u];
        // a × b without the cancellation of a short edge far away.
        vec3 plane = cross(a, b - a);
        float length2 = dot(plane, plane);
        cone.planes[i] = length2 > 1e-36 ? plane * (turn * inversesqrt(length2)) : vec3(0.0);
    }
}

// Azimuths of the cone in the space of a proxy, from vertex to vertex: between two of them the cone's interval is smooth.
// Where the cone contains ±z they go all around.
struct Azimuths {
    bool circle;
    uint panels;
    float edges[CONE_VERTICES + 1u];
};

const float TWO_PI = 2.0 * PI;

void azimuths_insert(inout Azimuths azimuths, uint count, float angle) {
    uint i = count;
    for (; i > 0u && azimuths.edges[i - 1u] > angle; --i) azimuths.edges[i] = azimuths.edges[i - 1u];
    azimuths.edges[i] = angle;
}

Azimuths cone_azimuths(Cone cone, Proxy proxy) {
    vec2 middle = vec2(0.0);
    bool above = true;
    bool below = true;
    for (uint i = 0u; i < cone.count; ++i) {
        float z = dot(cone.planes[i], proxy.local_from_q[2]);
        above = above && z >= 0.0;
        below = below && z <= 0.0;
        vec3 q = proxy.q_from_local * cone.vertices[i];
        middle += q.xy * inversesqrt(max(dot(q, q), TINY));
    }
    Azimuths azimuths;
    azimuths.circle = above || below;
    azimuths.panels = azimuths.circle ? cone.count : cone.count - 1u;
    // Angles are counted from the middle: a convex cone beside the axis spans less than π, and none of them wraps.
    if (azimuths.circle || dot(middle, middle) < 1e-20) middle = vec2(1.0, 0.0);
    float origin = atan(middle.y, middle.x);
    for (uint i = 0u; i < cone.count; ++i) {
        vec2 q = (proxy.q_from_local * cone.vertices[i]).xy;
        float along = dot(middle, q);
        float across = middle.x * q.y - middle.y * q.x;
        // A vertex on the axis has every azimuth, and atan none for it.
        float angle = abs(along) + abs(across) > 0.0 ? atan(across, along) : 0.0;
        azimuths_insert(azimuths, i, origin + angle);
    }
    azimuths.edges[cone.count] = azimuths.edges[0] + TWO_PI;
    return azimuths;
}

// Least and greatest cosθ of the cone at the azimuth of the unit vector `e`; the first is the greater where it is empty.
// A plane (A, B) = (n·e, n·z) leaves A sinθ + B cosθ ≥ 0: an upper bound of θ where B > 0, else a lower one.
vec2 cone_interval(Cone cone, Proxy proxy, vec2 e) {
    vec3 across = proxy.local_from_q * vec3(e, 0.0);
    vec3 axis = proxy.local_from_q[2];
    vec2 interval = vec2(-1.0, 1.0);
    for (uint i = 0u; i < cone.count; ++i) {
        float a = dot(cone.planes[i], across);
        float b = dot(cone.planes[i], axis);
        float cosine = abs(a) * inversesqrt(max(a * a + b * b, TINY));
        if (b > 0.0) {
            interval.x = max(interval.x, a > 0.0 ? -cosine : cosine);
        } else if (b < 0.0) {
            interval.y = min(interval.y, a > 0.0 ? cosine : -cosine);
        } else if (a < 0.0) {
            interval.x = 2.0;
        }
    }
    return interval;
}

#endif
