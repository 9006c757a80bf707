//! Disks and lines: small, close, far, thin, across the horizon, edge-on or end-on, through the point.

use super::super::super::formulas::{Case, Slots, absolute, relative};
use super::super::super::inputs::{at_cosine, ratio};
use super::{axes, direction, high, points};
use crate::reference::sampler::Random;
use glam::DVec3;

/// A disk.
fn disk(random: &mut Random, center: DVec3, normal: DVec3, radius: f64) -> Slots {
    let [u, v] = axes(random, normal, radius);
    points([center, u, v, DVec3::ZERO])
}

/// Turned no further than 80° from the point.
fn facing(random: &mut Random, toward: DVec3) -> DVec3 {
    let cosine = 0.17 + 0.83 * random.next();
    let lean = at_cosine(random, cosine);
    let (x, y) = toward.any_orthonormal_pair();
    lean.x * x + lean.y * y + lean.z * toward
}

/// In some direction, with a radius of between these shares of its distance.
fn small(random: &mut Random, [least, most]: [f64; 2]) -> Slots {
    let toward = high(random);
    let distance = ratio(random, 0.1, 1e3);
    let normal = facing(random, toward);
    let radius = distance * ratio(random, least, most);
    disk(random, distance * toward, normal, radius)
}

pub(in super::super) const ELLIPSE: &[Case] = &[
    relative("radius 1e-3 to .1 of its distance", |random| small(random, [1e-3, 0.1]), 1e-9),
    relative("radius 1e-5 to 1e-3 of its distance", |random| small(random, [1e-5, 1e-3]), 1e-9),
    relative(
        "radius 10 to 10,000 times its distance, overhead",
        |random| {
            let radius = ratio(random, 10.0, 1e4);
            disk(random, DVec3::Z, DVec3::Z, radius)
        },
        1e-6,
    ),
    relative(
        "radius .1 to 10, 1 up and up to 2 radii aside",
        |random| {
            let radius = ratio(random, 0.1, 10.0);
            let aside = 2.0 * radius * random.next();
            disk(random, DVec3::new(aside, 0.0, 1.0), DVec3::Z, radius)
        },
        f64::INFINITY,
    ),
    absolute(
        "radius .1 to 10 across the horizon",
        |random| {
            let normal = direction(random);
            let radius = ratio(random, 0.1, 10.0);
            let toward = direction(random);
            let height = radius * (1.0 - normal.z * normal.z).sqrt() * (2.0 * random.next() - 1.0);
            disk(random, toward.with_z(height), normal, radius)
        },
        f64::INFINITY,
    ),
    absolute(
        "edge-on, whole numbers",
        |random| {
            let [a, b] = loop {
                let [a, b] = [0; 2].map(|_| (16.0 * direction(random)).round());
                // A disk without area may pass through the point.
                if a.cross(b) != DVec3::ZERO {
                    break [a, b];
                }
            };
            points([3.0 * a + 2.0 * b, a, a - 2.0 * b, DVec3::ZERO])
        },
        1e-3,
    ),
];

/// With a radius of this share of its distance.
fn line(from: DVec3, to: DVec3, share: f64) -> Slots {
    let axis = (to - from).normalize();
    let radius = share * (from - axis * from.dot(axis)).length();
    points([from, to, DVec3::X * radius, DVec3::ZERO])
}

/// Through this point, turned at random about the vertical.
fn level(random: &mut Random, middle: DVec3, half: f64, share: f64) -> Slots {
    let along = half * at_cosine(random, 0.0);
    line(middle - along, middle + along, share)
}

/// By the bulge of its rims a level cylinder of 2 long and 0 to 1 up has at most .306 of this share more than a line
/// (`truth.rs`): 9.2e-5, below the 1e-4 within which the test of the table has both forms agree.
const THIN: f64 = 3e-4;

pub(in super::super) const LINE: &[Case] = &[
    relative(
        "radius 3e-4 of its distance, 2 long, .2 to 1 up",
        |random| {
            let up = ratio(random, 0.2, 1.0);
            level(random, DVec3::Z * up, 1.0, THIN)
        },
        1e-9,
    ),
    relative(
        "radius .01 to .1 of its distance, 2 long, .2 to 1 up",
        |random| {
            let (up, share) = (ratio(random, 0.2, 1.0), ratio(random, 0.01, 0.1));
            level(random, DVec3::Z * up, 1.0, share)
        },
        f64::INFINITY,
    ),
    relative(
        "1,000 to 10,000 km long, 1,000 km away, .01 of that thick",
        |random| {
            let half = ratio(random, 5e5, 5e6);
            let toward = high(random);
            level(random, 1e6 * toward, half, 0.01)
        },
        f64::INFINITY,
    ),
    relative(
        "radius 3e-4 of its distance, 2 long, 1e-3 to .2 up",
        |random| {
            let up = ratio(random, 1e-3, 0.2);
            level(random, DVec3::Z * up, 1.0, THIN)
        },
        1e-9,
    ),
    relative(
        "end-on: from 1–10 to 20–100 away, its axis .1 aside",
        |random| {
            let toward = high(random);
            let [aside, _] = axes(random, toward, 0.1);
            let [near, far] = [ratio(random, 1.0, 10.0), ratio(random, 20.0, 100.0)];
            line(near * toward + aside, far * toward + aside, THIN)
        },
        f64::INFINITY,
    ),
    relative(
        "radius 3e-4 of its distance, across the horizon",
        |random| {
            let cosine = 0.02 + 0.9 * random.next();
            let [up, down] = [cosine, -cosine].map(|cosine| at_cosine(random, cosine));
            line(up, ratio(random, 0.1, 10.0) * down, THIN)
        },
        f64::INFINITY,
    ),
    absolute(
        "through the point, or without length",
        |random| {
            let end = high(random) * ratio(random, 0.1, 10.0);
            let other = if random.next() < 0.5 { end } else { 2.0 * end };
            points([end, other, DVec3::X * 0.01, DVec3::ZERO])
        },
        1e-9,
    ),
];
