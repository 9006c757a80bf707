// Radiance from a node of lights, to second order in its extent: the cosine's part in closed form
// (src/light_tree/moments/sums.rs), that of other lobes by their mean over three directions.
#ifndef DIRECT_MOMENTS_GLSL
#define DIRECT_MOMENTS_GLSL

// Squared half width, in variances, of the distribution that stands for a node's lights where the horizon cuts them. 3 is a
// uniform one's.
const float UNIFORM2 = 3.0;

// Mean of max(x, 0) over a uniform distribution of mean mu and squared half width w2, and the share of it above 0: a
// node that the horizon cuts. (Gaussian instead: twice the bias. Clamping the mean: 6 % too dark in the penumbra.)
vec2 above_horizon(float mu, float w2) {
    float w = sqrt(max(w2, TINY));
    float share = clamp(0.5 + 0.5 * mu / w, 0.0, 1.0);
    return vec2(mu >= w ? mu : share * share * w, share);
}

// Below it nothing is left of a node, and a quotient by it is finite.
const float MIN_BENT = 1e-6;
// Of the node's mean cosine, what one of its directions has at least. All of it pushes those below the mean up, which made
// plastic of alpha 0.4 0.3 times the light_error too dark; a tenth lets what grazes the surface count for too much.
const float LEAST_COSINE = 0.5;

// Whether the BSDF is constant; known when the pipeline is compiled.
bool bsdf_is_constant() { return MODEL == MODEL_MATTE && !ROUGH_MATTE; }

// What a node makes of a pixel.
struct NodeLight {
    vec3 radiance;
    float irradiance;  // mean of the channels
    float horizon;  // Standard deviation of n·u among its lights times their irradiance at n·u = 1, where the horizon cuts them
};

// Irradiance over a node's intensity, times its squared distance.
struct NodeCosines {
    vec3 channels;
    vec3 bent;  // where it comes from in the mean: local, not normalised
    float least;  // cosine that directions have at least
    float horizon;  // standard deviation of n·u where the horizon cuts it, else 0
};

NodeCosines node_cosines(Surface s, Moments m, vec3 offset, float inverse2) {
    float inverse = sqrt(inverse2);
    vec3 u = offset * inverse;
    vec3 n = s.world_from_local[2];
    vec3 su = m.covariance * u * inverse2;
    vec3 sn = m.covariance * n * inverse2;
    float trace = (m.covariance[0].x + m.covariance[1].y + m.covariance[2].z) * inverse2;
    float mu = dot(n, u);
    // Lights above a surface often lie just above it: no wider than they reach below their centre, unless that is through
    // the surface.
    vec3 low = max(n * m.below, -n * m.above);
    vec3 high = max(n * m.above, -n * m.below);
    float depth = (low.x + low.y + low.z) * inverse;
    float height = (high.x + high.y + high.z) * inverse;
    float through = clamp(4.0 * (depth - mu) / max(depth, MIN_BENT), 0.0, 1.0);
    float variance = max(dot(n, sn), 0.0);
    float wide = UNIFORM2 * variance;
    vec2 above = above_horizon(mu, lerp(min(wide, depth * depth), wide, through));
    float cosine = above.x * (1.0 + 7.5 * dot(u, su) - 1.5 * trace) - 3.0 * dot(n, su) * above.y;
    vec3 slope = (n - 3.0 * mu * u) * (above.y * inverse);
    vec3 bent = vec3(0.0, 0.0, 1.0);
    if (!bsdf_is_constant()) {
        // c + S∇f/f: of the product of BSDF and irradiance this keeps the gradients' part. Without it Oren-Nayar is 0.7 % too
        // bright, with it within 0.2 %.
        vec3 shift = (sn * above.y - 3.0 * above.x * su) / max(above.x, MIN_BENT);
        // Across the way alone: along it nodes that are long would turn it round.
        bent = (u + shift - dot(shift, u) * u) * s.world_from_local;
    }
    vec3 channels = max(vec3(max(cosine, 0.0)) + m.shifts * slope, vec3(0.0));
    float least = max(LEAST_COSINE * above.x, MIN_BENT);
    return NodeCosines(channels, bent, least, mu < depth && mu > -height ? sqrt(variance) : 0.0);
}

// f towards a local direction, which is normalised.
vec3 reflectance(Surface s, vec3 way, float least) {
    vec3 wi = normalize(vec3(way.xy, max(way.z, least)));
    wi.z = max(wi.z, MIN_BENT);
    return bsdf_eval_cos(s.bsdf, wi) / wi.z;
}

// Roots of 1/2 and 3/2: corners of a triangle whose second moments are 1 along either axis.
const vec2 CORNER = vec2(0.70710678, 1.2247449);

// Mean of f over a node, at three directions that have its lights' mean and second moments across the way to it. At one
// alone metal of alpha 0.4 was 0.8 times the light_error too dark: tails of lobes are convex. No loop, for lavapipe ends
// them early (MAX_STEPS in cut.frag).
vec3 mean_reflectance(Surface s, Moments m, NodeCosines to, vec3 offset, float inverse2) {
    if (!lobe_is_narrow()) return reflectance(s, to.bent, to.least);
    vec3 u = offset * sqrt(inverse2);
    vec3 t = any_tangent(u);
    vec3 b = cross(u, t);
    vec3 st = m.covariance * t * inverse2;
    vec3 sb = m.covariance * b * inverse2;
    // Cholesky's root of the covariance along t and b.
    float tt = sqrt(max(dot(t, st), TINY));
    float tb = dot(b, st) / tt;
    float bb = sqrt(max(dot(b, sb) - tb * tb, 0.0));
    vec3 one = (CORNER.x * (tt * t + tb * b)) * s.world_from_local;
    vec3 two = (CORNER.y * bb * b) * s.world_from_local;
    vec3 middle = normalize(to.bent);
    vec3 sum = reflectance(s, middle + 2.0 * one, to.least);
    sum += reflectance(s, middle - one + two, to.least);
    sum += reflectance(s, middle - one - two, to.least);
    return sum / 3.0;
}

NodeLight reflected_node(Surface s, uint index) {
    Moments m = moments_at(index);
    vec3 offset = m.center - s.position;
    float inverse2 = 1.0 / max(dot(offset, offset), TINY);
    NodeCosines cosines = node_cosines(s, m, offset, inverse2);
    // Finite, or a product with 0 would be none.
    vec3 power = min(m.intensity * inverse2, MAX_RADIANCE);
    float mean = (power.r + power.g + power.b) / 3.0;
    // First, for the cosine that f was divided by may be as small as the light is strong.
    vec3 reflected = mean_reflectance(s, m, cosines, offset, inverse2) * cosines.channels;
    return NodeLight(reflected * power, dot(cosines.channels, power) / 3.0, cosines.horizon * mean);
}

#endif
