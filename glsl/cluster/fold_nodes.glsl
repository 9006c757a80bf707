// Nodes of folded lights, made of their sums, and how far they are off.

// Where folded lights fall on glossy surfaces too, to which it matters which way light comes.
layout(constant_id = 48) const bool GLOSSY = true;

// Of the light whose directions a node does not tell apart, what is wrong in a picture. A flat matte surface sees the vectors'
// sum, and hardly any of it. On five materials (tests/render/folds.rs) it makes the estimate 0.64 to 1.42 of the error.
float spread_share() { return GLOSSY ? 1.0 : 0.05; }

// A node, relative to the middle.
struct Node {
    vec3 irradiance;
    float mean;  // of its channels
    float kept;  // of it: where its lights are spread over directions, their vectors' sum is less than theirs
    vec3 slope;  // of the irradiance across the points, relative to its mean
    vec3 toward;  // unit
    float turn;  // inverse of its distance
};

// The linear function of least squares, and no more of it than leaves each point its share.
vec3 slope_of(vec3 lean) {
    vec3 slope = spread_inverse * (lean / max(trace, 1e-30));
    float least = 0.0;
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        if (k < point_count) least = min(least, dot(slope, points[k]));
    }
    return slope / max(-least, 1.0);
}

// The vector of irradiance that a node gives at a point, relative to its mean.
vec3 given(Node node, vec3 point) {
    return unit(node.toward - point * node.turn) * (1.0 + dot(node.slope, point));
}

vec3 mean_given(Node node) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        if (k < point_count) sum += given(node, points[k]) * share;
    }
    return sum;
}

Node node_of(uint first) {
    Node node;
    node.irradiance = vec3(node_sum(first), node_sum(first + 1u), node_sum(first + 2u));
    node.mean = dot(node.irradiance, MEAN_OF_RGB);
    float inverse_mean = node.mean > 0.0 ? 1.0 / node.mean : 0.0;
    vec3 lean = vec3(node_sum(first + 3u), node_sum(first + 4u), node_sum(first + 5u)) * inverse_mean;
    vec3 flow = vec3(node_sum(first + 6u), node_sum(first + 7u), node_sum(first + 8u)) * inverse_mean;
    float strength = length(flow);
    node.toward = unit(flow);
    node.slope = slope_of(lean);
    // Seen from x, the direction to a light at distance h turns by −x/h across the view: how places and directions vary
    // together. Not nearer than the points lie from one another, where that is no longer linear.
    float together = node_sum(first + 9u) * inverse_mean - dot(flow, lean);
    float across = trace * max(1.0 - dot(node.toward, spread * node.toward), 1e-3);
    float nearest = 2.0 * inversesqrt(max(trace, 1e-30));
    node.turn = min(max(-together, 0.0) / max(strength * across, 1e-30), nearest);
    // What the node gives in the mean is the vector that its lights give.
    vec3 wanted = node.toward;
    [[unroll]] for (uint i = 0u; i < 2u; ++i) node.toward = unit(node.toward + wanted - unit(mean_given(node)));
    node.kept = strength / max(length(mean_given(node)), 0.1);
    return node;
}

void store_node(Node node, uint texel) {
    vec3 toward = node.toward + middle * node.turn;
    imageStore(light_lists, list_texel(texel), floatBitsToUint(vec4(toward, node.turn)));
    imageStore(light_lists, list_texel(texel + 1u), floatBitsToUint(vec4(node.irradiance * node.kept, 0.0)));
    imageStore(light_lists, list_texel(texel + 2u), floatBitsToUint(vec4(node.slope, 1.0 - dot(node.slope, middle))));
}

// What the lights at a point give, by invocation, and behind those of all points what each node gives there.
void note_points() {
    uint lane = gl_LocalInvocationIndex;
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) words[k * LANES + lane] = floatBitsToUint(vec4(at_points[k], 0.0));
}

uint given_at(uint point) { return FOLD_POINTS * LANES + point * FOLD_NODES; }

void note_given(Node node) {
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        vec3 value = node.mean * node.kept * given(node, points[k]);
        words[given_at(k) + gl_LocalInvocationIndex] = floatBitsToUint(vec4(value, 0.0));
    }
}

// The share of the cluster's irradiance that is not where it was, or not from where: what the nodes' vectors miss at its points,
// and of what the spread of directions hides, which is `hidden` for this invocation's node.
float error_of(float hidden) {
    uint lane = gl_LocalInvocationIndex;
    float missed = 0.0;
    for (uint k = lane; k < point_count; k += LANES) {
        vec4 lights = sum_over(k * LANES, LANES) * float(point_count);
        missed += length((lights - sum_over(given_at(k), FOLD_NODES)).xyz);
    }
    barrier();
    words[lane] = floatBitsToUint(vec4(missed * share + spread_share() * hidden, total, 0.0, 0.0));
    barrier();
    vec4 all = sum_over(0u, LANES);
    return all.y > 0.0 ? min(all.x / all.y, 2.0) : 0.0;
}

// One invocation a node.
void write_nodes(uint id, uint texel) {
    uint lane = gl_LocalInvocationIndex;
    sum_nodes();
    note_points();
    float hidden = 0.0;
    if (lane < FOLD_NODES) {
        Node node = node_of(lane * SUMS);
        store_node(node, texel + 1u + lane * FOLD_TEXELS);
        note_given(node);
        hidden = node.mean * max(1.0 - node.kept, 0.0);
    }
    barrier();
    float error = error_of(hidden);
    if (lane != 0u) return;
    imageStore(light_lists, list_texel(texel), floatBitsToUint(vec4(base, 0.0)));
    clusters[id].error = error;
    // Not negative, so its bits are in the order of its values; a maximum does not depend on the order of writes.
    atomicMax(counters.fold_error, floatBitsToUint(error));
}
