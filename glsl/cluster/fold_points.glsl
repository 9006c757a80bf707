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
    if (gl_LocalInvocationIndex < FOLD_POINTS) {
        uint bit = nth_bit(cluster.pixels, min(gl_LocalInvocationIndex, point_count - 1u) * pixels / point_count);
        uvec2 pixel = min(corner + uvec2(bit % TILE_SIZE, bit / TILE_SIZE), frame.size - 1u);
        float z = view_depth(frame, texelFetch(depth_texture, ivec2(pixel), 0).r);
        places[gl_LocalInvocationIndex] = world_position(frame, vec2(pixel) + 0.5, z);
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

// Mean irradiance at the points, with the mean of the channels. Two passes compare it, so no compiler may contract it in one
// of them only.
float strength(uint light) {
    vec4 place = light_place(light);
    vec4 power = light_power(light);
    precise vec3 at = (place.xyz - base) - middle;
    precise float sum = 0.0;
    [[unroll]] for (uint k = 0u; k < FOLD_POINTS; ++k) {
        precise vec3 d = at - points[k];
        precise float d2 = dot(d, d);
        precise float x = d2 * place.w;
        precise float window = max(1.0 - x * x, 0.0);
        sum += window * window / max(d2, power.w);
    }
    return sum * (share * dot(power.rgb, vec3(1.0 / 3.0)));
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
