//! Inputs on which formulas of area lights break.

mod ellipses;
mod polygons;

use super::super::formulas::{Case, Slots, absolute, fitted};
use super::super::inputs::{apart, at_cosine, ratio};
use crate::ltc::{Layer, Parameters, Tables};
use crate::reference::sampler::Random;
use glam::{DVec3, Vec4};

pub(super) use ellipses::{ELLIPSE, LINE};
pub(super) use polygons::{FORM_FACTOR, HOLE, NOTCH, PARTS};

fn points(points: [DVec3; 4]) -> Slots {
    points.map(|point| point.as_vec3().extend(0.0).to_array())
}

/// Uniform over the sphere.
fn direction(random: &mut Random) -> DVec3 {
    let cosine = 2.0 * random.next() - 1.0;
    at_cosine(random, cosine)
}

/// Clear of the horizon, by a cosine of .15 at least.
fn high(random: &mut Random) -> DVec3 {
    let cosine = 0.15 + 0.85 * random.next();
    at_cosine(random, cosine)
}

/// Half axes of equal length across a direction.
fn axes(random: &mut Random, normal: DVec3, length: f64) -> [DVec3; 2] {
    let across = normal.any_orthonormal_vector();
    let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
    let u = length * (cos * across + sin * normal.cross(across));
    [u, normal.cross(u)]
}

/// Of metal.
fn lobe(random: &mut Random, tables: &Tables, [cosine, r]: [f64; 2]) -> Slots {
    let wo = at_cosine(random, cosine).as_vec3();
    let at = Parameters { r, cos: f64::from(wo.z).min(1.0) };
    let shape = tables.layer(Layer::Metal).shape_at(at).map(|number| number as f32);
    let twice_alpha = Vec4::X * (2.0 * r * r) as f32;
    [wo.extend(0.0).to_array(), shape, twice_alpha.to_array(), [0.0; 4]]
}

pub(super) const FURNACE: &[Case] = &[
    fitted(
        "r .03 to 1, n·wo .02 to 1",
        |random, tables| {
            let at = [ratio(random, 0.02, 1.0), ratio(random, 0.03, 1.0)];
            lobe(random, tables, at)
        },
        1e-6,
    ),
    fitted(
        "r .03 to 1, wo along the normal",
        |random, tables| {
            let r = ratio(random, 0.03, 1.0);
            lobe(random, tables, [1.0, r])
        },
        f64::INFINITY,
    ),
];

pub(super) const VIEWS: &[Case] = &[absolute(
    "wo within 1e-8 to 1 of n, and n itself",
    |random| {
        let n = direction(random);
        let lean = ratio(random, 1e-8, 1.0);
        let wo = if random.next() < 0.02 { n } else { apart(random, n, lean) };
        points([wo, n, DVec3::ZERO, DVec3::ZERO])
    },
    1e-3,
)];
