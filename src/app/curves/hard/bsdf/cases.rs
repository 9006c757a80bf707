//! Inputs on which formulas of BSDFs break: two directions and parameters.

use super::super::formulas::{Case, Slots, relative as case};
use super::super::inputs::{above, apart, at_cosine, ratio};
use crate::reference::sampler::Random;
use glam::DVec3;

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
