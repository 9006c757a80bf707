// A node of folded lights, behind its cluster's list.
#ifndef INDIRECT_NODE_GLSL
#define INDIRECT_NODE_GLSL

layout(constant_id = 60) const bool FOLDED = false;

// Radiance from a node: what its lights give at the cluster's middle, and how it changes across the cluster.
vec3 reflected_node(Surface surface, uint texel) {
    vec4 place = uintBitsToFloat(list_indices(texel));
    vec3 irradiance = uintBitsToFloat(list_indices(texel + 1u)).rgb;
    vec3 slope = uintBitsToFloat(list_indices(texel + 2u)).xyz;
    vec3 to_node = place.xyz - surface.position;
    vec3 wi = (to_node * inversesqrt(max(dot(to_node, to_node), 1e-30))) * surface.world_from_local;
    return bsdf_eval_cos(surface.bsdf, wi) * irradiance * max(place.w + dot(slope, surface.position), 0.0);
}

#endif
