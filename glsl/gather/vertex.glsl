// A vertex of a path: a surface, and how it reflects. Neighbouring pixels, and the places that their paths come to, have
// different models.
#ifndef GATHER_VERTEX_GLSL
#define GATHER_VERTEX_GLSL

layout(constant_id = 57) const bool GATHER_LAMBERT = false;

#include "lib/bsdf/mixed.glsl"
#include "lib/bsdf.glsl"
#include "lib/bsdf/lambert.glsl"
#include "lib/bsdf/sample.glsl"

struct Vertex {
    vec3 position;
    vec3 origin;  // of rays: moved off the surface
    vec3 geometric;  // normal of the triangle, on the side of the path
    mat3 world_from_local;
    Bsdf bsdf;
    BsdfSampling sampling;
    // What of its BSDF the lights stand for that were gathered at the vertex before, as a constant.
    vec3 taken;
    bool is_lambert;  // nothing but that constant times a cosine
    float bound;  // largest geometry term that virtual lights are gathered with, m⁻²
};

Vertex vertex_at(
        vec3 position, vec3 origin, vec3 geometric, mat3 world_from_local, BsdfParameters p, vec3 wo, float bound) {
    Vertex v;
    v.position = position;
    v.origin = origin;
    v.geometric = geometric;
    v.world_from_local = world_from_local;
    vec3 local = wo * world_from_local;
    v.bsdf = bsdf_setup(p, local);
    v.sampling = bsdf_sampling(p, local);
    v.taken = vec3(0.0);
    v.bound = bound;
    v.is_lambert = IS_MODEL(MODEL_MATTE) && p.sigma == 0.0;
    return v;
}

// f(wi) cosθ, without what is taken.
vec3 response(Vertex v, vec3 wi) { return bsdf_eval_cos(v.bsdf, wi) - v.taken * max(wi.z, 0.0); }

// Most of a BSDF, in that of a white Lambertian, that gathering takes over: of a narrower lobe's light the path finds more.
const float MOST_LOBE = 2.0;

// Which share of the light between two vertices gathering takes over; a path has the rest. `reflected` is the response.
float gathered_share(float bound, vec3 reflected, float cos_here, float cos_there, float d2) {
    float geometry = cos_here * cos_there;
    float lobe = greatest(reflected) * PI;
    float near = min(1.0, bound * d2 / max(geometry, TINY));
    // Paths look only for what is near: what is far has to be gathered, however bright the surface.
    if (GATHER_LAMBERT) return near;
    return near * min(1.0, MOST_LOBE * cos_here / max(lobe, TINY));
}

#endif
