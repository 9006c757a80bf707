// Radiance from a node of lights: to second order in its extent, for a cosine exactly (src/light_tree/moments/sums.rs),
// for other lobes as far as they are constant over the node.
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

// Whether the BSDF is constant; known when the pipeline is compiled.
bool bsdf_is_constant() { return MODEL == MODEL_MATTE && !ROUGH_MATTE; }

// Irradiance at n·u = 1 that the node would cause, over its intensity, by channel; `bent` is where it comes from in the mean.
vec3 node_cosines(Surface s, Moments m, vec3 offset, float inverse2, out vec3 bent) {
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
    float depth = (low.x + low.y + low.z) * inverse;
    float through = clamp(4.0 * (depth - mu) / max(depth, MIN_BENT), 0.0, 1.0);
    float wide = UNIFORM2 * dot(n, sn);
    vec2 above = above_horizon(mu, lerp(min(wide, depth * depth), wide, through));
    float cosine = above.x * (1.0 + 7.5 * dot(u, su) - 1.5 * trace) - 3.0 * dot(n, su) * above.y;
    vec3 slope = (n - 3.0 * mu * u) * (above.y * inverse);
    bent = vec3(0.0, 0.0, 1.0);
    if (!bsdf_is_constant()) {
        // c + S∇f/f: of the product of BSDF and irradiance this keeps the gradients' part. Without it Oren-Nayar is 0.7 % too
        // bright, with it within 0.2 %.
        float least = max(above.x, MIN_BENT);
        bent = (u + (sn * above.y - 3.0 * above.x * su) / least) * s.world_from_local;
        bent = normalize(vec3(bent.xy, max(bent.z, least)));
    }
    return max(vec3(max(cosine, 0.0)) + m.shifts * slope, vec3(0.0));
}

vec3 reflected_node(Surface s, uint index) {
    Moments m = moments_at(index);
    vec3 offset = m.center - s.position;
    float inverse2 = 1.0 / max(dot(offset, offset), TINY);
    vec3 bent;
    vec3 cosines = node_cosines(s, m, offset, inverse2, bent);
    // The bent direction's cosine is divided out again.
    return bsdf_eval_cos(s.bsdf, bent) * (m.intensity * cosines * (inverse2 / bent.z));
}

#endif
