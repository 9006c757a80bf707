// Form factor of outlines: irradiance over π times radiance, at the origin with normal +z, horizon clipped exactly.
//
// Lambert's edge sum, streamed: the state does not grow with the outline. Any number of rings, of either winding,
// concave, with holes wound the other way, bent on the sphere (edges are great circles):
//   FormFactor f = form_factor_begin();
//   for each ring { for its edges, in order: form_factor_edge(f, a, b);  form_factor_close_ring(f); }
//   float e = form_factor_end(f);
// Positive for a ring that is counter-clockwise seen from the origin: there the front of a polygon faces, by the right
// hand. A vertex with z = 0 counts as above the horizon, so a ring in the surface's own plane with the origin inside
// has ±1, the limit from above; one whose plane holds the origin but not the horizon has 0, between its limits ±1/2.
//
// Lights that are small seen from the origin need an anchor (form_factor_anchor), and vertices relative to it: the
// edges of a light of 1e-5 rad sum to 1e-10 out of terms of 1e-5, which leaves no digit. Against the anchor's weight
// w0 = 1/|anchor|² the terms are of the order of the sum,
//   Σ c w = Σ c (w − w0) + w0 Σ u × (v − u)     since closed rings have Σ anchor × (v − u) = 0,
// and w − w0 has a form without cancellation. Lengths from 1e-9 to 1e9.
#ifndef LIB_AREA_FORM_FACTOR_GLSL
#define LIB_AREA_FORM_FACTOR_GLSL

#include "lib/area/angle.glsl"

struct FormFactor {
    vec3 anchor;
    float anchor_weight; // 1/|anchor|²; 0 without an anchor
    float sum;
    vec2 entry;          // where the ring first came up through the horizon
    vec2 exit;           // and where it last went down; both relative to the anchor
    bool entered;
    bool left;
};

// Where vertices of a light within `radius` of `center` are to be taken relative to: its center when it is small, or
// the origin. Relative errors of 100,000 squares from 1e-5 to 3 rad, at cosines from .02 on: 1.5e-4 at worst.
vec3 form_factor_anchor(vec3 center, float radius) {
    return 16.0 * radius * radius < dot(center, center) ? center : vec3(0.0);
}

// Vertices are then relative to `anchor`, and within half its length of it.
FormFactor form_factor_begin(vec3 anchor) {
    float d2 = dot(anchor, anchor);
    return FormFactor(anchor, d2 > LEAST_SQUARE ? 1.0 / d2 : 0.0, 0.0, vec2(0.0), vec2(0.0), false, false);
}

FormFactor form_factor_begin() { return form_factor_begin(vec3(0.0)); }

// 2π times the part of the edge from anchor + u to anchor + v, both above the horizon, with normal c = (anchor + u) ×
// (v − u): c.z (w − w0) + w0 (u × (v − u)).z, w the angle over |c|. The sine is |c|, never √(1 − cos²): what a wall
// that stands on the surface 1e-7 away needs.
float form_factor_term(FormFactor f, vec3 u, vec3 v, vec3 c) {
    float cosine = dot(f.anchor + u, f.anchor + v);
    float sine2 = dot(c, c);
    float inverse_sine = inversesqrt(max(sine2, LEAST_SQUARE));
    // 1/(a·b) − 1/|anchor|² for the leading 1/(a·b).
    float lead = f.anchor_weight > 0.0 ? -(dot(f.anchor, u + v) + dot(u, v)) * f.anchor_weight : 1.0;
    float weight = angle_over_sine(cosine, sine2 * inverse_sine, inverse_sine, lead);
    return c.z * weight + f.anchor_weight * cross_2d(u.xy, v.xy - u.xy);
}

// The arc along the horizon that closes a clipped ring.
float form_factor_arc(FormFactor f, vec2 from, vec2 to) {
    vec2 a = f.anchor.xy + from, b = f.anchor.xy + to;
    vec3 c = vec3(0.0, 0.0, cross_2d(dot(a, a) < dot(b, b) ? a : b, to - from));
    return form_factor_term(f, vec3(from, -f.anchor.z), vec3(to, -f.anchor.z), c);
}

void form_factor_edge(inout FormFactor f, vec3 u, vec3 v) {
    vec3 a = f.anchor + u;
    vec3 b = f.anchor + v;
    bool a_above = a.z >= 0.0, b_above = b.z >= 0.0;
    // Of opposite sign where it is used; the weights are positive, so the crossing keeps the digits of the nearer end.
    float span = abs(a.z) + abs(b.z);
    vec2 crossing = (u.xy * abs(b.z) + v.xy * abs(a.z)) / max(span, LEAST_SQUARE);
    vec3 on_horizon = vec3(crossing, -f.anchor.z);
    // By the nearer end: of an edge that starts far away and ends at 1e-4 the other one leaves 7e-6 of error.
    vec3 c = cross(dot(a, a) < dot(b, b) ? a : b, v - u);
    if (a_above != b_above) {
        c *= max(a.z, b.z) / span;
    }
    if (a_above || b_above) {
        f.sum += form_factor_term(f, a_above ? u : on_horizon, b_above ? v : on_horizon, c);
    }
    if (b_above && !a_above) {
        if (f.left) {
            f.sum += form_factor_arc(f, f.exit, crossing);
        } else {
            f.entry = crossing;
            f.entered = true;
        }
        f.left = false;
    }
    if (a_above && !b_above) {
        f.exit = crossing;
        f.left = true;
    }
}

void form_factor_close_ring(inout FormFactor f) {
    if (f.left && f.entered) {
        f.sum += form_factor_arc(f, f.exit, f.entry);
    }
    f.left = false;
    f.entered = false;
}

float form_factor_end(FormFactor f) { return -0.5 * INV_PI * f.sum; }

#endif
