// What is summed over folded lights, by each invocation for itself and then over all, in the same order on every run.

// Sums of a node: mean irradiance rgb; over the points, irradiance times their places, times directions, times both.
const uint SUMS = 10u;
const uint NODE_QUADS = FOLD_NODES * SUMS / 4u;

// Counts of lights by strength; then four sums of each invocation each.
shared uvec4 words[NODE_QUADS * MOST_LANES];
shared uint highest;
// Over all invocations.
shared vec4 node_sums[NODE_QUADS];

mat3 octants;  // columns: axes that tell the nodes apart, the last across the surface
mat3 spread;  // covariance of the points over its trace
mat3 spread_inverse;
float trace;
float total = 0.0;  // of this invocation's lights, listed or not
float sums[FOLD_NODES * SUMS];
vec3 at_points[FOLD_POINTS];  // vectors of irradiance of those that it folds

// What the points see of a light, before its power.
struct Seen {
    float sum;
    vec3 moment;
    vec3 toward;
    float turn;
    vec3 flow[FOLD_POINTS];
};

Seen seen;

vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

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

void begin_sums() {
    spread = covariance(trace);
    spread_inverse = inverse(spread);
    vec3 n = across(spread_inverse);
    vec3 t = normalize(cross(abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), n));
    octants = mat3(t, cross(n, t), n);
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) at_points[k] = vec3(0.0);
    [[unroll]] for (uint i = 0u; i < FOLD_NODES * SUMS; ++i) sums[i] = 0.0;
}

void see(Beam beam) {
    precise float sum = 0.0;
    seen.moment = vec3(0.0);
    seen.toward = vec3(0.0);
    seen.turn = 0.0;
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        vec3 d;
        float d2;
        float value = falloff_at(beam, points[k], d, d2);
        vec3 flow = d * (value * inversesqrt(max(d2, 1e-30)));
        sum += value;
        seen.moment += points[k] * value;
        seen.toward += flow;
        seen.turn += dot(flow, points[k]);
        seen.flow[k] = flow;
    }
    seen.sum = sum;
}

// Adds the light that was seen last to its octant's node. Selects, not an index, which would put the sums in memory.
void fold(Beam beam, bool is_folded) {
    vec3 side = seen.toward * octants;
    uint octant = uint(side.x > 0.0) | uint(side.y > 0.0) << 1 | uint(side.z > 0.0) << 2;
    octant = is_folded ? octant : FOLD_NODES;
    float weight = is_folded ? dot(beam.power.rgb, MEAN_OF_RGB) * share : 0.0;
    vec3 irradiance = beam.power.rgb * (seen.sum * share);
    vec3 moment = seen.moment * weight;
    vec3 toward = seen.toward * weight;
    float own[SUMS] = float[SUMS](irradiance.x, irradiance.y, irradiance.z, moment.x, moment.y, moment.z, toward.x,
                                  toward.y, toward.z, seen.turn * weight);
    [[unroll]] for (uint node = 0u; node < FOLD_NODES; ++node) {
        [[unroll]] for (uint i = 0u; i < SUMS; ++i) sums[node * SUMS + i] += octant == node ? own[i] : 0.0;
    }
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) at_points[k] += seen.flow[k] * weight;
}

// Over all invocations, of four values each from `first` on.
vec4 sum_over(uint first, uint count) {
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < count; ++i) sum += uintBitsToFloat(words[first + i]);
    return sum;
}

// Makes `node_sums`.
void sum_nodes() {
    uint lane = gl_LocalInvocationIndex;
    barrier();
    [[unroll]] for (uint i = 0u; i < NODE_QUADS; ++i) {
        vec4 four = vec4(sums[4u * i], sums[4u * i + 1u], sums[4u * i + 2u], sums[4u * i + 3u]);
        words[i * LANES + lane] = floatBitsToUint(four);
    }
    barrier();
    for (uint i = lane; i < NODE_QUADS; i += LANES) node_sums[i] = sum_over(i * LANES, LANES);
    barrier();
}

float node_sum(uint i) { return node_sums[i / 4u][i % 4u]; }
