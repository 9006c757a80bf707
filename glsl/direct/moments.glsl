// Radiance from a node of lights: to second order in its extent, for a cosine exactly (src/light_tree/moments/sums.rs),
// for other lobes as far as they are constant over the node.
#ifndef DIRECT_MOMENTS_GLSL
#define DIRECT_MOMENTS_GLSL

// Half width, in standard deviations, of the uniform distribution.
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

vec3 reflected_node(Surface s, uint index) {
    Moments m = moments_at(index);
    vec3 offset = m.center - s.position;
    float inverse2 = 1.0 / max(dot(offset, offset), TINY);
    float inverse = sqrt(inverse2);
    vec3 u = offset * inverse;
    vec3 n = s.world_from_local[2];
    vec3 wi = u * s.world_from_local;
    vec3 su = m.covariance * u * inverse2;
    float trace = (m.covariance[0].x + m.covariance[1].y + m.covariance[2].z) * inverse2;
    vec2 above = above_horizon(wi.z, UNIFORM2 * dot(n, m.covariance * n) * inverse2);
    float cosine = above.x * (1.0 + 7.5 * dot(u, su) - 1.5 * trace) - 3.0 * dot(n, su) * above.y;
    vec3 slope = (n - 3.0 * wi.z * u) * (above.y * inverse);
    vec3 cosines = max(vec3(max(cosine, 0.0)) + m.shifts * slope, vec3(0.0));
    // Where the irradiance comes from in the mean, c + S∇f/f: of the product of BSDF and irradiance this keeps the gradients'.
    vec3 weighted = offset + m.covariance * ((n * above.y - 3.0 * above.x * u) * (inverse / max(above.x, MIN_BENT)));
    vec3 bent = normalize(weighted) * s.world_from_local;
    bent = normalize(vec3(bent.xy, max(bent.z, max(above.x, MIN_BENT))));
    return bsdf_eval_cos(s.bsdf, bent) * (m.intensity * cosines * (inverse2 / bent.z));
}

#endif
