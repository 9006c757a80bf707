//! Polygons: small, far, close, thin, across, on and below the horizon, edge-on, about the point; in parts, with a notch,
//! with a hole.

use super::super::super::formulas::{Case, Slots, absolute, relative};
use super::super::super::inputs::ratio;
use super::{axes, high, points};
use crate::reference::sampler::Random;
use glam::DVec3;

/// center ± u ± v.
fn parallelogram(center: DVec3, [u, v]: [DVec3; 2]) -> Slots {
    points([u + v, u - v, -u - v, v - u].map(|corner| center + corner))
}

/// A square of this side, at this distance in some direction, that faces the point.
fn square(random: &mut Random, toward: DVec3, distance: f64, side: f64) -> Slots {
    let axes = axes(random, toward, 0.5 * side);
    parallelogram(distance * toward, axes)
}

/// A whole number of −4 to 4.
fn whole(random: &mut Random) -> f64 {
    (9.0 * random.next()).floor() - 4.0
}

fn lattice(random: &mut Random) -> DVec3 {
    DVec3::new(whole(random), whole(random), whole(random))
}

/// Center and half axes of sixteenths, their plane no less than .1 from the point: no edge turns about it, and quarters meet.
fn clear(random: &mut Random) -> [DVec3; 3] {
    loop {
        let [center, u, v] = [0; 3].map(|_| (lattice(random) + lattice(random) / 8.0) / 2.0);
        let normal = u.cross(v);
        if normal.length() > 0.1 && center.dot(normal).abs() > 0.1 * normal.length() {
            return [center, u, v];
        }
    }
}

pub(in super::super) const FORM_FACTOR: &[Case] = &[
    relative(
        "square of 1e-5 to .1 of its distance",
        |random| {
            let toward = high(random);
            let distance = ratio(random, 0.1, 1e3);
            let side = distance * ratio(random, 1e-5, 0.1);
            square(random, toward, distance, side)
        },
        1e-6,
    ),
    relative(
        "square of 1 m to 1,000 km, 1,000 km away",
        |random| {
            let (toward, side) = (high(random), ratio(random, 1.0, 1e6));
            square(random, toward, 1e6, side)
        },
        1e-6,
    ),
    relative(
        "square of 10 to 10,000 times its distance, overhead",
        |random| {
            let distance = ratio(random, 0.1, 10.0);
            let side = distance * ratio(random, 10.0, 1e4);
            square(random, DVec3::Z, distance, side)
        },
        1e-9,
    ),
    relative(
        "wall of 2 × 1 that stands 1e-4 to 1 away",
        |random| {
            let away = ratio(random, 1e-4, 1.0);
            let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
            let (out, along) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
            let [a, b] = [along - away * out, -along - away * out];
            points([b, a, a + DVec3::Z, b + DVec3::Z])
        },
        1e-6,
    ),
    relative(
        "sliver, 10 to 10,000 times as long as wide, overhead",
        |random| {
            let (distance, aspect) = (ratio(random, 0.1, 10.0), ratio(random, 10.0, 1e4));
            let [u, v] = axes(random, DVec3::Z, distance);
            parallelogram(distance * DVec3::Z, [u, v / aspect])
        },
        1e-6,
    ),
    absolute(
        "parallelogram across the horizon",
        |random| {
            let [center, u, v] = clear(random);
            parallelogram(center.with_z(0.25 * center.z), [u, v])
        },
        1e-3,
    ),
    absolute(
        "whole numbers: corners at z = 0, twice, in a line",
        |random| {
            let [center, u, v] = clear(random).map(|p| (8.0 * p).round());
            points(
                [0; 4]
                    .map(|_| center + (whole(random) / 2.0).round() * u + (whole(random) / 2.0).round() * v),
            )
        },
        1e-3,
    ),
    absolute(
        "edge-on",
        |random| {
            let [s, t] = [lattice(random), lattice(random)];
            points([[1.0, 4.0], [5.0, 1.0], [7.0, 8.0], [2.0, 6.0]].map(|[x, y]| x * s + y * t))
        },
        1e-3,
    ),
    absolute(
        "0 to 1e-3 over the point: inside, edge or corner",
        |random| {
            let height = if random.next() < 0.5 { 0.0 } else { ratio(random, 1e-12, 1e-3) };
            // Quarters of a half axis, up to the outline.
            let [x, y] = [0; 2].map(|_| whole(random) / 4.0);
            parallelogram(DVec3::new(x, y, height), [DVec3::X, DVec3::NEG_Y])
        },
        1e-3,
    ),
    absolute(
        "below the horizon",
        |random| {
            let [center, u, v] = clear(random);
            parallelogram(center.with_z(-1.0 - u.z.abs() - v.z.abs()), [u, v])
        },
        1e-3,
    ),
];

pub(in super::super) const PARTS: &[Case] = &[absolute(
    "anywhere, across the horizon too",
    |random| {
        let [center, u, v] = clear(random);
        parallelogram(center, [u, v])
    },
    1e-3,
)];

pub(in super::super) const NOTCH: &[Case] = &[absolute(
    "anywhere, across the horizon too",
    |random| {
        let [center, u, v] = clear(random);
        points([center, u, v, DVec3::ZERO])
    },
    1e-3,
)];

pub(in super::super) const HOLE: &[Case] = &[relative(
    ".01 to .5 of a square wide, .1 to 100 sides away",
    |random| {
        let toward = high(random);
        let distance = ratio(random, 0.1, 100.0);
        let [u, v] = axes(random, toward, 0.5);
        let size = 1.0 - ratio(random, 0.01, 0.5);
        points([distance * toward, u, v, DVec3::X * size])
    },
    1e-6,
)];
