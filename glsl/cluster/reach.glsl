// Which lights reach a cluster: a walk over the light tree without a stack. Each invocation walks alone, so no
// subgroup size is assumed and the lights come in Hilbert order on every device. The including shader defines
// ON_LIGHT(index), called for each light whose sphere meets the cluster's box.
layout(local_size_x = LINEAR_GROUP) in;
layout(set = SET_scene, binding = SCENE_LIGHT_NODES, std430) readonly buffer NodeBlock { LightNode nodes[]; };

// Keeps a light whose window is 0 to the last bit rather than lose one to rounding.
const float REACH = 1.00001;

void visit_lights(vec3 lower, vec3 upper) {
  uint node = 0u;
  while (node < frame.node_count) {
    if (any(greaterThan(nodes[node].lower, upper)) || any(lessThan(nodes[node].upper, lower))) {
      node = nodes[node].skip;
      continue;
    }
    uint lights = nodes[node].lights;
    uint first = lights >> LEAF_COUNT_BITS;
    uint end = first + (lights & ((1u << LEAF_COUNT_BITS) - 1u));
    for (uint light = first; light < end; ++light) {
      vec4 place = light_place(light);
      vec3 to_box = max(max(lower - place.xyz, place.xyz - upper), vec3(0.0));
      if (dot(to_box, to_box) * place.w <= REACH) { ON_LIGHT(light) }
    }
    ++node;
  }
}
