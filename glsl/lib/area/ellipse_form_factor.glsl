// Form factor of an ellipse light in closed form, horizon clipped: irradiance over π times radiance, at the origin with
// normal +z, whichever side of the light is seen.
//
// The cone of directions is elliptical. In the frame of its axes the outline is (l1 cos ψ, l2 sin ψ, 1), and the edge sum
// becomes ∫ n·(−l2 cos ψ, −l1 sin ψ, l1 l2) / (1 + l1² cos² ψ + l2² sin² ψ) dψ, whose parts are an arc tangent each and,
// along the long axis, an artanh; above the horizon is one arc of ψ. The frame comes from the only positive eigenvalue of
// S = c cᵀ − a aᵀ − b bᵀ, approached from above by Laguerre's method: for a circle the start is the root already.
//
// Against 24-point Gauss panels in double precision the formula is exact to 1e-14. Quadrature of the same arc with 16
// points errs by up to .3 where the rim is near, which this does not know.
#ifndef LIB_AREA_ELLIPSE_FORM_FACTOR_GLSL
#define LIB_AREA_ELLIPSE_FORM_FACTOR_GLSL

#include "lib/area/angle.glsl"

// Directions (x/l1)² + (y/l2)² ≤ 1 for x, y and 1 along major, minor and axis.
struct EllipseFrame {
    vec3 major;
    vec3 minor;
    vec3 axis;
    float l1;
    float l2; // at most l1; 0 edge-on, and then nothing else is meant to be read
};

// The positive eigenvalue of c cᵀ − x xᵀ, given |c|² − |x|² and |c × x|²: above that of S for any half axis x.
float ellipse_bound(float trace, float cross2) {
    float root = sqrt(trace * trace + 4.0 * cross2);
    return trace > 0.0 ? 0.5 * (trace + root) : 2.0 * cross2 / max(root - trace, LEAST_SQUARE);
}

// The largest root of x³ − trace x² + minors x − det, which is positive and simple; x is above it. All roots are real, so
// the steps never pass it. From the least of three bounds: at the rim four steps leave 7e-3 of the form factor in the
// worst of 20,000, five 1e-5; from the first bound alone five left 2e-1.
float ellipse_root(float x, float trace, float minors, float det) {
    for (int i = 0; i < 5; i++) {
        float value = ((x - trace) * x + minors) * x - det;
        float slope = (3.0 * x - 2.0 * trace) * x + minors;
        float bend = 6.0 * x - 2.0 * trace;
        float root = sqrt(max(4.0 * slope * slope - 6.0 * value * bend, 0.0));
        x = max(x - 3.0 * value / max(slope + root, LEAST_SQUARE), LEAST_SQUARE);
    }
    return x;
}

EllipseFrame ellipse_frame(vec3 c, vec3 a, vec3 b) {
    vec3 size = max(max(abs(c), abs(a)), abs(b));
    float scale = 1.0 / max(max(size.x, max(size.y, size.z)), LEAST_SQUARE);
    // Before scaling, which would round an edge-on ellipse out of its plane.
    vec3 n = cross(a, b);
    float volume = dot(c, n) * scale * scale * scale;
    n *= scale * scale;
    c *= scale;
    a *= scale;
    b *= scale;
    // Conjugate half axes of which the first points at the foot of the origin: c = reach a + d n/|n|.
    float n2 = dot(n, n);
    vec2 foot = vec2(dot(cross(c, b), n), dot(cross(a, c), n)) / max(n2, LEAST_SQUARE);
    float reach = length(foot);
    vec2 turn = reach > 1e-18 ? foot / reach : vec2(1.0, 0.0);
    vec3 old_a = a, old_b = b;
    a = turn.x * old_a + turn.y * old_b;
    b = turn.x * old_b - turn.y * old_a;
    float det = volume * volume;
    float d2 = det / max(n2, LEAST_SQUARE);
    float a2 = dot(a, a), b2 = dot(b, b), c2 = dot(c, c);
    float old_a2 = dot(old_a, old_a), old_b2 = dot(old_b, old_b);
    float start = ellipse_bound(c2 - a2, d2 * a2);
    start = min(start, ellipse_bound(c2 - old_a2, foot.y * foot.y * n2 + d2 * old_a2));
    start = min(start, ellipse_bound(c2 - old_b2, foot.x * foot.x * n2 + d2 * old_b2));
    float minors = n2 * (1.0 - reach) * (1.0 + reach) - d2 * (a2 + b2);
    float value = ellipse_root(start, c2 - a2 - b2, minors, det);

    // Its eigenvector: the longest cross product of two rows of S − value.
    vec3 row_x = c.x * c - a.x * a - b.x * b - vec3(value, 0.0, 0.0);
    vec3 row_y = c.y * c - a.y * a - b.y * b - vec3(0.0, value, 0.0);
    vec3 row_z = c.z * c - a.z * a - b.z * b - vec3(0.0, 0.0, value);
    vec3 yz = cross(row_y, row_z), zx = cross(row_z, row_x), xy = cross(row_x, row_y);
    float length_yz = dot(yz, yz), length_zx = dot(zx, zx), length_xy = dot(xy, xy);
    vec3 axis = length_yz > length_zx ? yz : zx;
    axis = length_xy > max(length_yz, length_zx) ? xy : axis;
    axis *= inversesqrt(max(dot(axis, axis), LEAST_SQUARE));
    axis = dot(axis, c) < 0.0 ? -axis : axis;

    // The others: one Jacobi rotation of −S in the plane across the axis (Duff et al. 2017, for its basis).
    float sign_z = axis.z < 0.0 ? -1.0 : 1.0;
    float k = -1.0 / (sign_z + axis.z);
    vec3 u = vec3(1.0 + sign_z * axis.x * axis.x * k, sign_z * axis.x * axis.y * k, -sign_z * axis.x);
    vec3 v = vec3(axis.x * axis.y * k, sign_z + axis.y * axis.y * k, -axis.y);
    vec3 along_u = vec3(dot(a, u), dot(b, u), dot(c, u)), along_v = vec3(dot(a, v), dot(b, v), dot(c, v));
    vec3 signature = vec3(1.0, 1.0, -1.0);
    float uu = dot(signature * along_u, along_u), vv = dot(signature * along_v, along_v);
    float uv = dot(signature * along_u, along_v);
    float spread = sqrt((uu - vv) * (uu - vv) + 4.0 * uv * uv);
    float tangent = 2.0 * uv / max(abs(uu - vv) + spread, LEAST_SQUARE);
    float cosine = inversesqrt(1.0 + tangent * tangent);
    vec2 first = uu >= vv ? vec2(cosine, tangent * cosine) : vec2(tangent * cosine, cosine);
    float l1_2 = max(0.5 * (uu + vv + spread) / value, LEAST_SQUARE);
    // From the determinant, not from the difference of the rotation.
    float l2_2 = det / value / value / value / l1_2;
    EllipseFrame frame;
    frame.axis = axis;
    frame.major = first.x * u + first.y * v;
    frame.minor = first.x * v - first.y * u;
    frame.l1 = sqrt(l1_2);
    frame.l2 = det > LEAST_SQUARE ? min(sqrt(l2_2), frame.l1) : 0.0;
    return frame;
}

// 2π times the part above the horizon, for one that crosses it: the arc of the outline, and the chord along the horizon.
// n is the normal in the frame, q and r the cosine and sine of half the arc.
float ellipse_clipped(EllipseFrame frame, vec3 n, vec2 middle, float q, float r) {
    float p1 = sqrt(1.0 + frame.l1 * frame.l1), p2 = sqrt(1.0 + frame.l2 * frame.l2);
    float excess = sqrt((frame.l1 - frame.l2) * (frame.l1 + frame.l2));
    vec2 from = middle * q + vec2(middle.y, -middle.x) * r;
    vec2 to = middle * q + vec2(-middle.y, middle.x) * r;
    vec2 stretch = vec2(p1, p2), m = stretch * middle, f = stretch * from, t = stretch * to;
    // Each half from the middle, so that a full turn is not taken for none.
    float turn = angle_of(max(cross_2d(m, t), 0.0), dot(m, t))
        + angle_of(max(cross_2d(f, m), 0.0), dot(m, f));
    float along_z = (frame.l1 / p1) * (frame.l2 / p2) * turn;

    vec2 change = 2.0 * r * vec2(-middle.y, middle.x);
    float w_from = length(vec3(frame.l1 * from.x, frame.l2 * from.y, 1.0));
    float w_to = length(vec3(frame.l1 * to.x, frame.l2 * to.y, 1.0));
    float denominator = p1 * p1 - excess * excess * from.y * to.y;
    float y = abs(excess * p1 * change.y) / denominator;
    float along_x = -frame.l2 * change.y / denominator * artanh_over(min(y, 1.0), sqr(w_from / denominator * w_to));

    float sine = abs(excess * p2 * change.x);
    float cosine = p2 * p2 + excess * excess * from.x * to.x;
    float along_y = frame.l1 * change.x * angle_over_sine(cosine, sine, 1.0 / max(sine, 1e-18), 1.0);

    vec3 a = vec3(frame.l1 * to.x, frame.l2 * to.y, 1.0), b = vec3(frame.l1 * from.x, frame.l2 * from.y, 1.0);
    vec3 c = vec3(frame.l2 * change.y, -frame.l1 * change.x, frame.l1 * frame.l2 * cross_2d(to, from));
    return dot(n, vec3(along_x, along_y, along_z)) + angle_of(dot(n, c), dot(a, b));
}

float ellipse_form_factor(vec3 center, vec3 a, vec3 b) {
    EllipseFrame frame = ellipse_frame(center, a, b);
    // Height of the outline over the horizon: n.z + (l1 n.x, l2 n.y)·(cos ψ, sin ψ).
    vec3 n = vec3(frame.major.z, frame.minor.z, frame.axis.z);
    vec2 slope = vec2(frame.l1, frame.l2) * n.xy;
    float h = length(slope);
    if (frame.l2 <= 0.0 || n.z <= -h) {
        return 0.0;
    }
    float p1 = sqrt(1.0 + frame.l1 * frame.l1), p2 = sqrt(1.0 + frame.l2 * frame.l2);
    float whole = (frame.l1 / p1) * (frame.l2 / p2) * n.z;
    float q = clamp(-n.z / max(h, LEAST_SQUARE), -1.0, 1.0);
    float clipped = ellipse_clipped(frame, n, slope / max(h, LEAST_SQUARE), q, sqrt((1.0 - q) * (1.0 + q)));
    return n.z >= h ? whole : max(0.5 * INV_PI * clipped, 0.0);
}

#endif
