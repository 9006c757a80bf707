//! Materials and directions that crowd where float32 goes wrong.

use std::f64::consts::TAU;

use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use glam::DVec3;

use crate::common::albedo::at_cosine;
use crate::probe::Case;

/// Numbers of the five models, in the order of `shared::MODEL_*`.
pub(crate) const MODEL_NAMES: [&str; 5] = ["matte", "plastic", "metal", "substrate", "principled"];

/// Point `index` of an additive recurrence in as many dimensions as are asked for: Kronecker's sequence of the square
/// roots of primes, with the same points on every run.
pub(crate) struct Points {
    index: f64,
    dimension: usize,
}

const PRIMES: [f64; 24] = [
    2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0, 59.0, 61.0,
    67.0, 71.0, 73.0, 79.0, 83.0, 89.0,
];

impl Points {
    pub(crate) fn new(index: u32) -> Self {
        Self { index: f64::from(index) + 1.0, dimension: 0 }
    }

    /// The next coordinate, in [0, 1).
    fn next(&mut self) -> f64 {
        let root = PRIMES[self.dimension].sqrt();
        self.dimension += 1;
        (self.index * root).fract()
    }

    /// In [0, 1], an end of it for every third point.
    fn unit(&mut self) -> f64 {
        (self.next() * 1.5 - 0.25).clamp(0.0, 1.0)
    }

    /// From `low` to `high` by equal ratios, with both ends as in [`Points::unit`].
    fn ratio(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    fn choice(&mut self, count: u32) -> u32 {
        (self.next() * f64::from(count)) as u32
    }

    fn color(&mut self) -> DVec3 {
        let (r, gb) = (self.unit(), self.next());
        DVec3::new(r, gb, (gb * 7.0).fract())
    }

    /// Alpha from 1e-3 to 1, of both axes alike in every second point.
    fn ggx(&mut self) -> Ggx {
        let alpha_x = self.ratio(1e-3, 1.0);
        let (other, same) = (self.ratio(1e-3, 1.0), self.next() < 0.5);
        Ggx { alpha_x, alpha_y: if same { alpha_x } else { other } }
    }

    /// Below 1, exactly 1, and up to 3.
    fn eta(&mut self) -> f64 {
        let x = self.next();
        if x < 0.1 { 1.0 } else { 0.2 + 2.8 * x }
    }
}

/// A material of model number `model`, and two directions.
pub(crate) fn case(model: usize, index: u32) -> Case {
    let mut points = Points::new(index);
    let (wo, wi) = directions(&mut points);
    Case::new(&material(model, &mut points), wo, wi)
}

fn material(model: usize, p: &mut Points) -> Bsdf {
    match MODEL_NAMES[model] {
        "matte" => Bsdf::Matte(Matte { color: p.color(), sigma: 90.0 * p.unit() }),
        "plastic" => Bsdf::Plastic(Plastic {
            diffuse: p.color(),
            specular: p.color(),
            eta: p.eta(),
            alpha: p.ratio(1e-3, 1.0),
        }),
        "metal" => Bsdf::Metal(Metal { eta: 3.0 * p.color(), k: 8.0 * p.color(), ggx: p.ggx() }),
        "substrate" => Bsdf::Substrate(Substrate { diffuse: p.color(), specular: p.color(), ggx: p.ggx() }),
        _ => principled(p),
    }
}

fn principled(p: &mut Points) -> Bsdf {
    let (roughness, aspect) = (p.unit(), (1.0 - 0.9 * p.unit()).sqrt());
    let alpha = roughness * roughness;
    Bsdf::Principled(Principled {
        base_color: p.color(),
        metallic: p.unit(),
        eta: p.eta(),
        roughness,
        ggx: Ggx { alpha_x: (alpha / aspect).max(1e-3), alpha_y: (alpha * aspect).max(1e-3) },
        specular_tint: p.unit(),
        sheen: p.unit(),
        sheen_tint: p.unit(),
        clearcoat: p.unit(),
        clearcoat_gloss: p.unit(),
        subsurface: p.unit(),
    })
}

/// Both above the surface: anywhere, grazing down to a cosine of 1e-6, near the normal, near the mirror direction, near
/// retro-reflection, or exactly one of these.
fn directions(p: &mut Points) -> (DVec3, DVec3) {
    let kind = p.choice(8);
    let (phi_o, phi_i) = (360.0 * p.next(), 360.0 * p.next());
    let (a, b) = (p.next(), p.next());
    let grazing = |x: f64| 1e-6_f64.powf(x);
    let wo = at_cosine(if kind < 4 { a } else { grazing(a) }, phi_o);
    let turned = |about: DVec3, angle: f64| above(about + angle * across(about, phi_i));
    let mirror = DVec3::new(-wo.x, -wo.y, wo.z);
    let wi = match kind {
        0 | 4 => at_cosine(1.0 - b, phi_i),
        1 | 5 => at_cosine(grazing(b), phi_i),
        2 | 6 => turned(mirror, 1e-5_f64.powf(b)),
        3 => turned(wo, 1e-5_f64.powf(b)),
        _ => *[wo, mirror, DVec3::Z, turned(DVec3::Z, 1e-5_f64.powf(b))].get((b * 4.0) as usize).unwrap(),
    };
    (wo, wi)
}

/// A unit vector orthogonal to `v`.
fn across(v: DVec3, phi: f64) -> DVec3 {
    let (x, y) = v.any_orthonormal_pair();
    let phi = phi / 360.0 * TAU;
    x * phi.cos() + y * phi.sin()
}

fn above(v: DVec3) -> DVec3 {
    let v = v.normalize();
    DVec3::new(v.x, v.y, v.z.abs().max(1e-6))
}

/// Directions that no picture should hold, and some that it will: below the surface, opposite, none at all.
pub(crate) fn hostile(model: usize, index: u32) -> Case {
    let case = case(model, index);
    let (wo, wi) = (case.wo, case.wi);
    let flat = |v: DVec3, z: f64| DVec3::new(v.x, v.y, 0.0).normalize_or(DVec3::X).with_z(z);
    let (wo, wi) = match index % 10 {
        0 => (wo, wi.with_z(-wi.z)),
        1 => (wo.with_z(-wo.z), wi),
        2 => (-wo, -wi),
        3 => (wo, -wo),
        4 => (flat(wo, 0.0), -flat(wo, 0.0)),
        5 => (flat(wo, 1e-6), -flat(wo, -1e-6)),
        6 => (flat(wo, 1e-6), flat(wo, 1e-6)),
        7 => (flat(wo, 1e-30), flat(wi, 1e-20)),
        8 => (wo, DVec3::ZERO),
        _ => (DVec3::Z, *[DVec3::Z, -DVec3::Z, DVec3::X].get(index as usize % 3).unwrap()),
    };
    Case::new(&case.bsdf, wo, wi)
}
