//! Rectangles of uniform light at random: the cosines' closed form against the lobe summed over directions.

use crate::{Random, at, tables};
use amas::ltc::{Layer, Lobe};
use amas::reference::bsdf::{Bsdf, Ggx, Metal};
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

/// Form factor of the polygon mapped by `inverse`, clipped to z > 0; its winding does not matter.
fn transformed_cosine(inverse: &DMat3, corners: &[DVec3; 4]) -> f64 {
    let mapped = corners.map(|corner| *inverse * corner);
    let mut clipped = Vec::new();
    for (i, a) in mapped.into_iter().enumerate() {
        let b = mapped[(i + 1) % 4];
        if a.z > 0.0 {
            clipped.push(a);
        }
        if (a.z > 0.0) != (b.z > 0.0) {
            clipped.push((a + (b - a) * (a.z / (a.z - b.z))).with_z(0.0));
        }
    }
    let edge = |a: DVec3, b: DVec3| {
        let cross = a.cross(b);
        let length = cross.length();
        if length > 0.0 { length.atan2(a.dot(b)) / length * cross.z } else { 0.0 }
    };
    let sum: f64 = (0..clipped.len()).map(|i| edge(clipped[i], clipped[(i + 1) % clipped.len()])).sum();
    sum.abs() / std::f64::consts::TAU
}

struct Rectangle {
    centre: DVec3,
    x: DVec3,
    y: DVec3,
}

impl Rectangle {
    fn corners(&self) -> [DVec3; 4] {
        let Self { centre, x, y } = *self;
        [centre - x - y, centre + x - y, centre + x + y, centre - x + y]
    }

    /// Sides of .04 to 2 at distance 1, turned towards the point; about a direction of the lobe or of the hemisphere.
    fn at_random(random: &mut Random, lobe: &Samples) -> Self {
        let centre = if random.next() < 0.5 {
            let index = (random.next() * lobe.directions.len() as f64) as usize;
            lobe.directions[index]
        } else {
            random.above()
        };
        let side = |random: &mut Random| 0.02 * 50.0_f64.powf(random.next());
        let normal = (random.above() - 2.0 * centre).normalize();
        let x = normal.cross(random.above()).normalize();
        Self { centre, x: x * side(random), y: normal.cross(x) * side(random) }
    }

    fn hit_by(&self, w: DVec3) -> bool {
        let normal = self.x.cross(self.y);
        let t = self.centre.dot(normal) / w.dot(normal);
        let p = t * w - self.centre;
        t > 0.0
            && p.dot(self.x).abs() <= self.x.length_squared()
            && p.dot(self.y).abs() <= self.y.length_squared()
    }
}

/// Directions by the oracle's own sampling, with f cos / density / count.
struct Samples {
    directions: Vec<DVec3>,
    weights: Vec<f64>,
}

impl Samples {
    fn new(lobe: &Lobe, r: f64) -> Self {
        let ggx = Ggx::isotropic(r * r);
        let metal = Bsdf::Metal(Metal { eta: DVec3::ONE, k: DVec3::ONE, ggx });
        let side = 600;
        let pairs = (0..side * side).filter_map(|i| {
            let xi = DVec2::new(f64::from(i % side) + 0.5, f64::from(i / side) + 0.5) / f64::from(side);
            let wi = metal.sample(lobe.wo, xi).normalize();
            (wi.z > 0.0).then(|| (wi, lobe.eval(wi) / metal.pdf(lobe.wo, wi) / f64::from(side * side)))
        });
        let (directions, weights) = pairs.unzip();
        Self { directions, weights }
    }

    fn over(&self, rectangle: &Rectangle) -> f64 {
        let pairs = self.directions.iter().zip(&self.weights);
        pairs.filter(|(w, _)| rectangle.hit_by(**w)).map(|(_, weight)| weight).sum()
    }
}

/// Roughness, angle, and the most that the mean error of the 400 may be, over the lobe's energy. The first three are
/// what another fitter of four numbers reached; published matrices have .0265, .0240 and .0112 there.
const CELLS: [(f64, f64, f64); 7] = [
    (0.51, 78.0, 0.0082),
    (0.60, 78.0, 0.0058),
    (0.79, 61.0, 0.0024),
    (0.30, 60.0, 0.0020),
    (0.20, 80.0, 0.0050),
    (0.10, 45.0, 0.0001),
    (0.40, 87.0, 0.0140),
];

#[test]
fn no_rectangle_is_beyond_the_bound() {
    for (r, degrees, allowed) in CELLS {
        let lobe = Lobe::new(Layer::Metal, at(r, degrees));
        let samples = Samples::new(&lobe, r);
        let lookup = tables().lookup(Layer::Metal, r, lobe.wo.z);
        let (mass, bound) = (lookup.mass(), lookup.moments[3]);
        let mut random = Random((1000.0 * r) as u64);
        let rectangles: Vec<_> = (0..400).map(|_| Rectangle::at_random(&mut random, &samples)).collect();
        let pairs: Vec<_> = rectangles
            .par_iter()
            .map(|rectangle| {
                (mass * transformed_cosine(&lookup.inverse, &rectangle.corners()), samples.over(rectangle))
            })
            .collect();
        let errors = pairs.iter().map(|(ours, exact)| (ours - exact).abs());
        let (sum, most) = errors.fold((0.0, 0.0_f64), |(sum, most), error| (sum + error, most.max(error)));
        let (mean, light) = (sum / 400.0 / mass, pairs.iter().map(|(_, exact)| exact).sum::<f64>());
        println!(
            "r {r} {degrees}°: mean {mean:.4}, largest {:.4} of the energy, bound {bound:.4}; {:.4} of the light",
            most / mass,
            sum / light
        );
        // 360,000 directions say where a light's edge is to about 2e-4 of the energy.
        assert!(most <= mass * (bound + 2e-4), "r {r} {degrees}°: {} {bound}", most / mass);
        assert!(mean < allowed, "r {r} {degrees}°: {mean}");
    }
}
