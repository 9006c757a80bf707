//! Inputs on which formulas break, from random numbers: four slots of four numbers that float32 holds.

use super::formulas::{Case, Slots};
use crate::reference::sampler::Random;
use glam::DVec3;

/// By equal ratios.
fn ratio(random: &mut Random, least: f64, most: f64) -> f64 {
    least * (most / least).powf(random.next())
}

/// With this cosine to +z, at any azimuth.
fn at_cosine(random: &mut Random, cosine: f64) -> DVec3 {
    let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
    let radius = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    DVec3::new(radius * cos, radius * sin, cosine)
}

fn above(random: &mut Random) -> DVec3 {
    let cosine = 0.05 + 0.95 * random.next();
    at_cosine(random, cosine)
}

fn slots(wo: DVec3, wi: DVec3, parameters: [f64; 3]) -> Slots {
    let parameters = DVec3::from_array(parameters);
    [wo, wi, parameters, DVec3::ZERO].map(|v| v.as_vec3().extend(0.0).to_array())
}

fn scalars(parameters: [f64; 3]) -> Slots {
    slots(DVec3::Z, DVec3::Z, parameters)
}

/// `wo` mirrored at a normal that leans by `lean` radians.
fn mirrored(random: &mut Random, wo: DVec3, lean: f64) -> DVec3 {
    let h = at_cosine(random, lean.cos());
    (2.0 * wo.dot(h) * h - wo).normalize()
}

/// Within some alphas of a highlight's middle.
fn highlight(random: &mut Random, wo: DVec3) -> Slots {
    let alpha = ratio(random, 1e-3, 0.1);
    let lean = alpha * ratio(random, 1e-2, 10.0);
    let wi = mirrored(random, wo, lean);
    slots(wo, wi, [alpha, 0.0, 0.0])
}

/// Two directions of this angle.
fn apart(random: &mut Random, wo: DVec3, angle: f64) -> DVec3 {
    let across = wo.any_orthonormal_vector();
    let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
    let side = cos * across + sin * wo.cross(across);
    (angle.cos() * wo + angle.sin() * side).normalize()
}

/// A square of this side, at this distance from the origin in some direction above it, that faces it.
fn square(random: &mut Random, toward: DVec3, distance: f64, side: f64) -> Slots {
    let u = toward.any_orthonormal_vector();
    let turn = std::f64::consts::TAU * random.next();
    let u = 0.5 * side * (turn.cos() * u + turn.sin() * toward.cross(u));
    let v = toward.cross(u);
    [u + v, u - v, -u - v, v - u].map(|corner| (distance * toward + corner).as_vec3().extend(0.0).to_array())
}

const fn case(name: &'static str, make: fn(&mut Random) -> Slots, plain: f64) -> Case {
    Case { name, make, plain }
}

pub(super) const DISTRIBUTION: &[Case] = &[
    case(
        "alpha 1e-3 to .1, highlight",
        |random| {
            let wo = above(random);
            highlight(random, wo)
        },
        1e-9,
    ),
    case(
        "the same, at 1e-4 to .05 over the horizon",
        |random| {
            let cosine = ratio(random, 1e-4, 0.05);
            let wo = at_cosine(random, cosine);
            highlight(random, wo)
        },
        1e-9,
    ),
];

pub(super) const SCHLICK: &[Case] = &[case(
    "wi within .2 of wo, and the same",
    |random| {
        let wo = above(random);
        let angle = ratio(random, 1e-4, 0.2);
        let wi = if random.next() < 0.02 { wo } else { apart(random, wo, angle) };
        slots(wo, wi, [0.0; 3])
    },
    1e-50,
)];

pub(super) const HALF_COSINE: &[Case] = &[case(
    "wi within .2 of −wo, and −wo itself",
    |random| {
        let wo = above(random);
        let angle = ratio(random, 1e-4, 0.2);
        let wi = if random.next() < 0.02 { -wo } else { apart(random, -wo, angle) };
        slots(wo, wi, [0.0; 3])
    },
    1e-5,
)];

pub(super) const VISIBILITY: &[Case] = &[case(
    "cosines of 1e-10 to 1, and 0",
    |random| {
        let cosines = [0, 1].map(|_| ratio(random, 1e-10, 1.0));
        let [wo, mut wi] = cosines.map(|cosine| at_cosine(random, cosine));
        if random.next() < 0.02 {
            wi.z = 0.0;
        }
        let alpha = ratio(random, 1e-3, 1.0);
        slots(wo, wi, [alpha, 0.0, 0.0])
    },
    1e-6,
)];

pub(super) const DIELECTRIC: &[Case] = &[
    case(
        "eta 1 + 1e-5 to 1.1",
        |random| {
            let eta = 1.0 + ratio(random, 1e-5, 0.1);
            scalars([eta, random.next(), 0.0])
        },
        1e-20,
    ),
    case(
        "eta .5 to .99: total reflection",
        |random| {
            let eta = 0.5 + 0.49 * random.next();
            scalars([eta, random.next(), 0.0])
        },
        1e-20,
    ),
];

pub(super) const CONDUCTOR: &[Case] = &[
    case(
        "eta 1e-3 to 1, k 1 to 30",
        |random| scalars([ratio(random, 1e-3, 1.0), ratio(random, 1.0, 30.0), random.next()]),
        1e-9,
    ),
    case("eta = k = 0", |random| scalars([0.0, 0.0, random.next().max(0.02)]), 1e-9),
    case("the same, along the normal", |_| scalars([0.0, 0.0, 1.0]), 1e-9),
];

pub(super) const COMPLEMENT: &[Case] =
    &[case("x of 1e-10 to 1", |random| scalars([ratio(random, 1e-10, 1.0), 0.0, 0.0]), 1e-11)];

pub(super) const OREN_NAYAR: &[Case] = &[case(
    "wo within 1e-4 to .1 of the normal",
    |random| {
        let lean = ratio(random, 1e-4, 0.1);
        let wo = at_cosine(random, lean.cos());
        // On the same side: s > 0.
        let side = wo.with_z(0.0).normalize_or(DVec3::X);
        let turn = 2.0 * (random.next() - 0.5);
        let side = DVec3::new(
            turn.cos() * side.x - turn.sin() * side.y,
            turn.sin() * side.x + turn.cos() * side.y,
            0.0,
        );
        let cosine = ratio(random, 1e-6, 0.999);
        slots(wo, (1.0 - cosine * cosine).sqrt() * side + cosine * DVec3::Z, [0.0; 3])
    },
    1e-12,
)];

pub(super) const CLEARCOAT: &[Case] = &[case(
    "alpha 1e-3 to .1, highlight",
    |random| {
        let wo = above(random);
        highlight(random, wo)
    },
    1e-9,
)];

pub(super) const SUBSURFACE: &[Case] = &[case(
    "cosines of 1e-10 to 1, and both 0",
    |random| {
        let black = random.next() < 0.02;
        let [i, o] = [0, 1].map(|_| if black { 0.0 } else { ratio(random, 1e-10, 1.0) });
        scalars([i, o, if black { 0.0 } else { ratio(random, 1e-10, 1.0) }])
    },
    1e-3,
)];

pub(super) const TANGENT: &[Case] = &[case(
    "normals within 1e-12 to 1 of +y, and +y itself",
    |random| {
        let lean = ratio(random, 1e-12, 1.0);
        let n = if random.next() < 0.02 { DVec3::Y } else { apart(random, DVec3::Y, lean) };
        slots(n, DVec3::Z, [0.0; 3])
    },
    0.5,
)];

pub(super) const FORM_FACTOR: &[Case] = &[
    case(
        "square of 1e-5 to .1 of its distance",
        |random| {
            // Clear of the horizon, at which neither usual form nor truth clips.
            let cosine = 0.1 + 0.9 * random.next();
            let toward = at_cosine(random, cosine);
            let distance = ratio(random, 0.1, 1e3);
            let side = distance * ratio(random, 1e-5, 0.1);
            square(random, toward, distance, side)
        },
        1e-6,
    ),
    case(
        "square of 10 to 10,000 times its distance, overhead",
        |random| {
            let distance = ratio(random, 0.1, 10.0);
            let side = distance * ratio(random, 10.0, 1e4);
            square(random, DVec3::Z, distance, side)
        },
        1e-9,
    ),
    case(
        "wall of 2 × 1 that stands 1e-4 to 1 away",
        |random| {
            let away = ratio(random, 1e-4, 1.0);
            let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
            let (out, along) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
            let [a, b] = [along - away * out, -along - away * out];
            [b, a, a + DVec3::Z, b + DVec3::Z].map(|corner| corner.as_vec3().extend(0.0).to_array())
        },
        1e-6,
    ),
    case(
        "sliver, 10 to 10,000 times as long as wide, overhead",
        |random| {
            let (distance, aspect) = (ratio(random, 0.1, 10.0), ratio(random, 10.0, 1e4));
            let turn = DVec3::X * (std::f64::consts::TAU * random.next()).cos();
            let u = distance * turn.with_y((1.0 - turn.x * turn.x).sqrt());
            let v = DVec3::Z.cross(u) / aspect;
            [u + v, u - v, -u - v, v - u]
                .map(|corner| (distance * DVec3::Z + corner).as_vec3().extend(0.0).to_array())
        },
        1e-6,
    ),
];
