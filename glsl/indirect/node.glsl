// A node of folded lights, behind its cluster's list.
#ifndef INDIRECT_NODE_GLSL
#define INDIRECT_NODE_GLSL

layout(constant_id = 60) const bool FOLDED = false;

// Radiance from a node: what its lights give in the cluster's mean, and how that and its direction change across it. All
// is relative to a point of the cluster, which `first` holds: far from the origin differences of coordinates are exact.
vec3 reflected_node(Surface surface, uint first, uint node) {
    uint texel = first + 1u + node * FOLD_TEXELS;
    vec3 from = surface.position - uintBitsToFloat(list_indices(first).xyz);
    vec4 toward = uintBitsToFloat(list_indices(texel));
    vec3 irradiance = uintBitsToFloat(list_indices(texel + 1u)).rgb;
    vec4 slope = uintBitsToFloat(list_indices(texel + 2u));
    vec3 to_node = toward.xyz - from * toward.w;
    vec3 wi = (to_node * inversesqrt(max(dot(to_node, to_node), 1e-30))) * surface.world_from_local;
    return bsdf_eval_cos(surface.bsdf, wi) * irradiance * max(slope.w + dot(slope.xyz, from), 0.0);
}

#endif
