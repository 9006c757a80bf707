// A path from a vertex on: at each vertex of it, virtual lights stand for the Lambertian share of what the surfaces beyond
// reflect: of that, the part that does not grow beyond a bound (Kollig and Keller 2004, Illumination in the Presence of Weak
// Singularities). The rest is found by the path: the light that the next vertex reflects, but for what was gathered of it.
#ifndef GATHER_PATH_GLSL
#define GATHER_PATH_GLSL

#include "gather/light.glsl"
// After the models.
#include "bind/hit.glsl"

// Bounces before a path may be ended by chance.
const uint SAFE_BOUNCES = 2u;
// Of the bound, where one light is drawn from the tree instead of being chosen among many: what is near is left to the path
// from twice as far. Without it, and with the tree before this one, the error after 8 rounds was 1.04, 1.04, 1.04 and 1.34
// times as large.
const float LONE = 0.25;

// Light of the scene's own lights.
vec3 own_lights(Vertex v) {
    vec3 sum = vec3(0.0);
    if (gather.points.y > 0u) sum += drawn(v, gather.points, UNBOUNDED, UNBOUNDED, 0u, ALL_AROUND);
    if (gather.emitters.y > 0u) sum += drawn(v, gather.emitters, UNBOUNDED, UNBOUNDED, 0u, WITH_NORMALS);
    return sum;
}

// Bounces are those that are left.
vec3 virtual_lights(Vertex v, bool seen, uint bounces) {
    if (gather.virtuals.y == 0u || bounces == 0u) return vec3(0.0);
    if (seen) return chosen(v, first_light, gather.virtuals, 0.0, v.bound, bounces, WITH_NORMALS);
    return drawn(v, gather.virtuals, UNBOUNDED, v.bound, bounces, WITH_NORMALS);
}

// Along a sampled direction: light of the background, or the next vertex with what the path has to find there.
struct Step {
    Vertex vertex;
    vec3 throughput;
    bool goes_on;
};

Step step_from(Vertex v, vec3 throughput, inout vec3 radiance) {
    vec3 wi = bsdf_sample(v.sampling, random_pair());
    float pdf = bsdf_pdf(v.sampling, wi);
    vec3 direction = v.world_from_local * wi;
    bool leaves = pdf > 0.0 && wi.z > 0.0 && dot(direction, v.geometric) > 0.0;
    vec3 reflected = leaves ? response(v, wi) : vec3(0.0);
    throughput *= reflected / max(pdf, TINY);
    Step next = Step(v, throughput, false);
    if (!leaves || throughput == vec3(0.0)) return next;
    // Gathering takes over whatever is farther.
    float reach = GATHER_LAMBERT ? inversesqrt(v.bound) : 1e30;
    Hit hit = nearest_hit(v.origin, direction, reach);
    if (hit.triangle == NO_HIT) {
        radiance += throughput * frame.background;
        return next;
    }
    HitSurface s = hit_surface(hit, direction);
    vec3 n = s.geometric_normal;
    float share = gathered_share(v.bound, reflected, wi.z, -dot(n, direction), sqr(hit.t));
    surface_model = s.model;
    vec3 origin = offset_origin(s.position, n, hit.t);
    next.vertex = vertex_at(s.position, origin, n, s.world_from_local, s.parameters, -direction, LONE * gather.bound);
    next.vertex.taken = bsdf_lambert(s.parameters) * (share * INV_PI);
    next.goes_on = s.drawn && !(next.vertex.is_lambert && share >= 1.0);
    return next;
}

vec3 indirect(Vertex v) {
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    bool goes_on = true;
    for (uint bounce = 0u; bounce <= gather.bounces && goes_on; ++bounce) {
        if (bounce > 0u) radiance += throughput * own_lights(v);
        radiance += throughput * virtual_lights(v, bounce == 0u, gather.bounces - bounce);
        // Behind the last bounce there is only the background.
        goes_on = bounce < gather.bounces || frame.background != vec3(0.0);
        if (goes_on && bounce >= SAFE_BOUNCES) {
            float survival = min(greatest(abs(throughput)), 0.95);
            goes_on = random() < survival;
            throughput /= max(survival, TINY);
        }
        if (goes_on) {
            Step next = step_from(v, throughput, radiance);
            v = next.vertex;
            throughput = next.throughput;
            goes_on = next.goes_on;
        }
    }
    return radiance;
}

#endif
