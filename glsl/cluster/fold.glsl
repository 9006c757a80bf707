// Nodes of folded lights: sums of each invocation for each octant, in shared memory, added up in the same order on every run.

// Sums: mean irradiance rgb; over the points, irradiance times their places, times directions, times both.
const uint SUMS = 10u;
const uint NODE_WORDS = FOLD_NODES * SUMS * FOLD_LANES;
// Where folded lights fall on glossy surfaces too, to which it matters which way light comes.
layout(constant_id = 48) const bool GLOSSY = true;

// Of the light whose directions a node does not tell apart, what is wrong in a picture. A flat matte surface sees the vectors'
// sum, and hardly any of it. On five materials (tests/render/folds.rs) it makes the estimate 0.64 to 1.42 of the error.
float spread_share() { return GLOSSY ? 1.0 : 0.05; }

const vec3 MEAN_OF_RGB = vec3(1.0 / 3.0);

// Counts of lights by strength; then sums of nodes; then what is made of these.
shared uint words[NODE_WORDS];
mat3 octants;  // columns: axes that tell the nodes apart, the last across the surface
mat3 spread;  // covariance of the points over its trace
mat3 spread_inverse;
float trace;
float total = 0.0;  // of this invocation's lights, listed or not
vec3 at_points[FOLD_POINTS];  // vectors of irradiance of those that it folds

uint light_of(uint group, uint i);

vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

float word(uint i) { return uintBitsToFloat(words[i]); }

// The direction in which the points spread least: the inverse's eighth power has hardly any other column.
vec3 across(mat3 inverse) {
    mat3 power = inverse / (abs(inverse[0][0]) + abs(inverse[1][1]) + abs(inverse[2][2]));
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        power = power * power;
        power /= max(power[0][0] + power[1][1] + power[2][2], 1e-30);
    }
    vec3 diagonal = vec3(power[0][0], power[1][1], power[2][2]);
    vec3 n = diagonal.x >= max(diagonal.y, diagonal.z) ? power[0] : diagonal.y >= diagonal.z ? power[1] : power[2];
    return unit(n);
}

void clear_nodes() {
    spread = covariance(trace);
    spread_inverse = inverse(spread);
    vec3 n = across(spread_inverse);
    vec3 t = normalize(cross(abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), n));
    octants = mat3(t, cross(n, t), n);
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) at_points[k] = vec3(0.0);
    for (uint i = gl_LocalInvocationIndex; i < NODE_WORDS; i += FOLD_LANES) words[i] = 0u;
    barrier();
}

void add(uint at, float value) { words[at] = floatBitsToUint(word(at) + value); }

void add(uint at, vec3 value) {
    [[unroll]] for (uint i = 0u; i < 3u; ++i) add(at + i * FOLD_LANES, value[i]);
}

void fold_light(uint light) {
    vec4 place = light_place(light);
    vec4 power = light_power(light);
    vec3 at = (place.xyz - base) - middle;
    float weight = dot(power.rgb, MEAN_OF_RGB) * share;
    float mean = 0.0;
    vec3 moment = vec3(0.0);
    vec3 toward = vec3(0.0);
    float turn = 0.0;
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        vec3 d = at - points[k];
        float d2 = dot(d, d);
        float value = falloff(d2, place.w, power.w);
        vec3 flow = d * (value * inversesqrt(max(d2, 1e-30)));
        mean += value;
        moment += points[k] * value;
        toward += flow;
        turn += dot(flow, points[k]);
        at_points[k] += flow * weight;
    }
    vec3 side = toward * octants;
    uint octant = uint(side.x > 0.0) | uint(side.y > 0.0) << 1 | uint(side.z > 0.0) << 2;
    uint first = octant * SUMS * FOLD_LANES + gl_LocalInvocationIndex;
    add(first, power.rgb * (mean * share));
    add(first + 3u * FOLD_LANES, moment * weight);
    add(first + 6u * FOLD_LANES, toward * weight);
    add(first + 9u * FOLD_LANES, turn * weight);
}

// Adds lights of a group.
void fold(uint group, uint lights) {
    for (; lights != 0u; lights &= lights - 1u) fold_light(light_of(group, uint(findLSB(lights))));
}

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
    node.irradiance = vec3(word(first), word(first + 1u), word(first + 2u));
    node.mean = dot(node.irradiance, MEAN_OF_RGB);
    float inverse_mean = node.mean > 0.0 ? 1.0 / node.mean : 0.0;
    vec3 lean = vec3(word(first + 3u), word(first + 4u), word(first + 5u)) * inverse_mean;
    vec3 flow = vec3(word(first + 6u), word(first + 7u), word(first + 8u)) * inverse_mean;
    float strength = length(flow);
    node.toward = unit(flow);
    node.slope = slope_of(lean);
    // Seen from x, the direction to a light at distance h turns by −x/h across the view: how places and directions vary
    // together. Not nearer than the points lie from one another, where that is no longer linear.
    float together = word(first + 9u) * inverse_mean - dot(flow, lean);
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

// Words of what is made of the sums: those of all invocations; at each point, what each invocation folded; in all of each;
// at each point, what each node gives; what of each has other directions.
const uint OF_POINTS = FOLD_NODES * SUMS;
const uint OF_TOTALS = OF_POINTS + 3u * FOLD_POINTS * FOLD_LANES;
const uint OF_NODES = OF_TOTALS + FOLD_LANES;
const uint OF_SPREADS = OF_NODES + FOLD_NODES * 3u * FOLD_POINTS;
const uint LANE_SUMS = (FOLD_NODES * SUMS + FOLD_LANES - 1u) / FOLD_LANES;

float sum_of(uint first, uint count) {
    float sum = 0.0;
    for (uint i = 0u; i < count; ++i) sum += word(first + i);
    return sum;
}

vec3 sum3_of(uint first, uint count) {
    return vec3(sum_of(first, count), sum_of(first + count, count), sum_of(first + 2u * count, count));
}

// Sums over invocations, from `words` to its beginning.
void sum_words() {
    uint lane = gl_LocalInvocationIndex;
    float sums[LANE_SUMS];
    barrier();
    [[unroll]] for (uint i = 0u; i < LANE_SUMS; ++i) {
        uint index = min(lane + i * FOLD_LANES, FOLD_NODES * SUMS - 1u);
        sums[i] = sum_of(index * FOLD_LANES, FOLD_LANES);
    }
    barrier();
    [[unroll]] for (uint i = 0u; i < LANE_SUMS; ++i) {
        uint index = lane + i * FOLD_LANES;
        if (index < FOLD_NODES * SUMS) words[index] = floatBitsToUint(sums[i]);
    }
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        [[unroll]] for (uint axis = 0u; axis < 3u; ++axis) {
            words[OF_POINTS + (3u * k + axis) * FOLD_LANES + lane] = floatBitsToUint(at_points[k][axis]);
        }
    }
    words[OF_TOTALS + lane] = floatBitsToUint(total);
    barrier();
}

// The share of the cluster's irradiance that is not where it was, or not from where: what the nodes' vectors miss at its points,
// and of what the spread of directions hides.
float error_of() {
    float missed = 0.0;
    for (uint k = 0u; k < point_count; ++k) {
        missed += length(sum3_of(OF_POINTS + 3u * k * FOLD_LANES, FOLD_LANES) * float(point_count)
                         - sum3_of(OF_NODES + 3u * k * FOLD_NODES, FOLD_NODES));
    }
    float all = sum_of(OF_TOTALS, FOLD_LANES);
    float error = missed * share + spread_share() * sum_of(OF_SPREADS, FOLD_NODES);
    return all > 0.0 ? min(error / all, 2.0) : 0.0;
}

// One invocation a node.
void write_nodes(uint id, uint texel) {
    uint lane = gl_LocalInvocationIndex;
    sum_words();
    if (lane < FOLD_NODES) {
        Node node = node_of(lane * SUMS);
        store_node(node, texel + 1u + lane * FOLD_TEXELS);
        [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
            vec3 value = node.mean * node.kept * given(node, points[k]);
            [[unroll]] for (uint axis = 0u; axis < 3u; ++axis) {
                words[OF_NODES + (3u * k + axis) * FOLD_NODES + lane] = floatBitsToUint(value[axis]);
            }
        }
        words[OF_SPREADS + lane] = floatBitsToUint(node.mean * max(1.0 - node.kept, 0.0));
    }
    barrier();
    if (lane != 0u) return;
    imageStore(light_lists, list_texel(texel), floatBitsToUint(vec4(base, 0.0)));
    float error = error_of();
    clusters[id].error = error;
    // Not negative, so its bits are in the order of its values; a maximum does not depend on the order of writes.
    atomicMax(counters.fold_error, floatBitsToUint(error));
}
