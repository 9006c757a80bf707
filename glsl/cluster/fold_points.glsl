// Where a cluster's light is measured: at surfaces of its pixels, all of them where it has up to FOLD_POINTS, as clusters of
// quadrants do, else as many, evenly spread over them. Not in its box: of that, lights whose range is short may reach a part
// where no surface is.
const uint FOLD_POINTS = 16u;
const vec3 NOWHERE = vec3(1e15);

shared vec3 places[FOLD_POINTS];

vec3 base;  // one of the surfaces, to which nodes are relative
vec3 middle;  // mean of all, relative to it
vec3 points[FOLD_POINTS];  // relative to the middle; at NOWHERE beyond the last
uint point_count;
float share;  // of each point

void load_points(Cluster cluster) {
    uvec2 corner = uvec2(cluster.tile % frame.tiles.x, cluster.tile / frame.tiles.x) * TILE_SIZE;
    uint pixels = uint(bitCount(cluster.pixels.x) + bitCount(cluster.pixels.y));
    point_count = clamp(pixels, 1u, FOLD_POINTS);
    share = 1.0 / float(point_count);
    for (uint k = gl_LocalInvocationIndex; k < FOLD_POINTS; k += LANES) {
        uint bit = nth_bit(cluster.pixels, min(k, point_count - 1u) * pixels / point_count);
        uvec2 pixel = min(corner + uvec2(bit % TILE_SIZE, bit / TILE_SIZE), frame.size - 1u);
        float z = view_depth(frame, texelFetch(depth_texture, ivec2(pixel), 0).r);
        places[k] = world_position(frame, vec2(pixel) + 0.5, z);
    }
    barrier();
    base = places[0];
    middle = vec3(0.0);
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        points[k] = places[k] - base;
        if (k < point_count) middle += points[k] * share;
    }
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) points[k] = k < point_count ? points[k] - middle : NOWHERE;
}

// A light, as the points see it.
struct Beam {
    vec4 place;  // relative to their middle
    vec4 power;
};

Beam beam_of(uint light) {
    vec4 place = light_place(light);
    precise vec3 at = (place.xyz - base) - middle;
    return Beam(vec4(at, place.w), light_power(light));
}

// `falloff` at a point. Two passes compare sums of it, so no compiler may contract it in one of them only.
float falloff_at(Beam beam, vec3 point, out vec3 d, out float d2) {
    precise vec3 to_light = beam.place.xyz - point;
    precise float square = dot(to_light, to_light);
    precise float x = square * beam.place.w;
    precise float window = max(1.0 - x * x, 0.0);
    precise float value = window * window / max(square, beam.power.w);
    d = to_light;
    d2 = square;
    return value;
}

// Mean irradiance at the points, with the mean of the channels, for the sum over them.
float strength(Beam beam, float sum) {
    precise float value = sum * (share * dot(beam.power.rgb, MEAN_OF_RGB));
    return value;
}

// Relative to the trace: 1 plus what keeps points of a plane, a line or one place apart; least along the view, across which
// surfaces lie if their points do not say.
mat3 covariance(out float trace) {
    mat3 sum = mat3(0.0);
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        if (k < point_count) sum += outerProduct(points[k], points[k]) * share;
    }
    trace = sum[0][0] + sum[1][1] + sum[2][2];
    vec3 view = frame.eye - base;
    view = dot(view, view) > 0.0 ? normalize(view) : frame.forward;
    const float RIDGE = 1e-3;
    return sum / max(trace, 1e-30) + RIDGE * (mat3(1.0) - 0.9 * outerProduct(view, view));
}
