// Nodes of folded lights: sums of each invocation for each octant, in shared memory, added up in the same order on every run.

// Points of the box, in units of its half side over √3.
const vec3 FOLD_POINTS[4] = vec3[](vec3(1.0, 1.0, 1.0), vec3(1.0, -1.0, -1.0), vec3(-1.0, 1.0, -1.0), vec3(-1.0, -1.0, 1.0));
// Sums: mean irradiance rgb; irradiance at the points; that times positions, and times directions.
const uint SUMS = 13u;

shared float node_sums[FOLD_NODES * SUMS * FOLD_NODES];
shared vec2 spreads[FOLD_NODES];  // irradiance in all, and what the spread of directions takes from its sum
float total = 0.0;

float strength(uint light, out vec4 at_points);
uint light_of(uint group, uint i);

void clear_nodes() {
    for (uint i = gl_LocalInvocationIndex; i < FOLD_NODES * SUMS * FOLD_NODES; i += FOLD_NODES) node_sums[i] = 0.0;
    barrier();
}

void add(uint first, vec3 value) {
    [[unroll]] for (uint i = 0u; i < 3u; ++i) node_sums[first + i * FOLD_NODES] += value[i];
}

void fold_light(uint light, bool listed) {
    vec4 at_points;
    float mean = strength(light, at_points);
    total += mean;
    if (listed) return;
    vec4 power = light_power(light);
    vec3 to_light = light_place(light).xyz - middle;
    uint octant = uint(to_light.x > 0.0) | uint(to_light.y > 0.0) << 1 | uint(to_light.z > 0.0) << 2;
    uint first = octant * SUMS * FOLD_NODES + gl_LocalInvocationIndex;
    float weight = dot(power.rgb, vec3(1.0 / 3.0));
    add(first, power.rgb * (weight > 0.0 ? mean / weight : 0.0));
    [[unroll]] for (uint k = 0u; k < 4u; ++k) node_sums[first + (3u + k) * FOLD_NODES] += at_points[k];
    // Relative to the middle: float32 sums positions far from the origin badly.
    add(first + 7u * FOLD_NODES, to_light * mean);
    add(first + 10u * FOLD_NODES, to_light * (mean * inversesqrt(max(dot(to_light, to_light), 1e-20))));
}

// Adds the lights of a group that reach the cluster and are not listed.
void fold(uint group, uint reaching, uint listed) {
    for (uint first = 0u; first < LEAF_LIGHTS; first += UNROLLED) {
        [[unroll]] for (uint j = 0u; j < UNROLLED; ++j) {
            uint bit = 1u << (first + j);
            if ((reaching & bit) != 0u) fold_light(light_of(group, first + j), (listed & bit) != 0u);
        }
    }
}

float sum_of(uint index) {
    float sum = 0.0;
    uint first = (gl_LocalInvocationIndex * SUMS + index) * FOLD_NODES;
    [[unroll]] for (uint i = 0u; i < FOLD_NODES; ++i) sum += node_sums[first + i];
    return sum;
}

vec3 sum3_of(uint index) { return vec3(sum_of(index), sum_of(index + 1u), sum_of(index + 2u)); }

// One invocation a node. Where its lights are spread over directions, the irradiance of their vectors' sum is less than
// theirs: that is what a diffuse surface receives.
void write_nodes(uint id, uint first) {
    uint lane = gl_LocalInvocationIndex;
    barrier();
    vec3 irradiance = sum3_of(0u);
    vec4 points = vec4(sum_of(3u), sum_of(4u), sum_of(5u), sum_of(6u)) * 0.25;
    float mean = dot(points, vec4(1.0));
    float inverse = mean > 0.0 ? 1.0 / mean : 0.0;
    vec3 toward = sum3_of(10u);
    float kept = min(length(toward) * inverse, 1.0);
    // The linear function through the points' values, relative to their mean.
    vec3 slope = vec3(0.0);
    [[unroll]] for (uint k = 0u; k < 4u; ++k) slope += FOLD_POINTS[k] * points[k];
    slope *= inverse / max(offsets, vec3(1e-20));
    // The mean distance, in the direction of the sum.
    vec3 position = middle + sum3_of(7u) * inverse;
    uint texel = first + lane * FOLD_TEXELS;
    imageStore(light_lists, list_texel(texel), floatBitsToUint(vec4(position, 1.0 - dot(slope, middle))));
    imageStore(light_lists, list_texel(texel + 1u), floatBitsToUint(vec4(irradiance * kept, 0.0)));
    imageStore(light_lists, list_texel(texel + 2u), floatBitsToUint(vec4(slope, 0.0)));

    spreads[lane] = vec2(total, mean * (1.0 - kept));
    barrier();
    if (lane != 0u) return;
    vec2 all = vec2(0.0);
    [[unroll]] for (uint i = 0u; i < FOLD_NODES; ++i) all += spreads[i];
    // The share of the irradiance that the spread of directions hides. The largest over the clusters was 1.7 to 2.7 times
    // the picture's mean error on five materials, for caps of 8 to 128 (tests/render/folds.rs).
    float error = all.x > 0.0 ? all.y / all.x : 0.0;
    clusters[id].error = error;
    // Not negative, so its bits are in the order of its values; a maximum does not depend on the order of writes.
    atomicMax(counters.fold_error, floatBitsToUint(error));
}
