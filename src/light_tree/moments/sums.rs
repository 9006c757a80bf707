//! Moments of intensity about a centroid, and what a node that keeps only the first three of them gets wrong.
//!
//! A surface with unit normal n at the origin receives from an intensity I at r the irradiance I f(r), f = n·r/|r|³. Over
//! lights at c + δ, with ⟨⟩ their mean by intensity, ⟨δ⟩ = 0 and S = ⟨δδᵀ⟩, Taylor's series about c = d u is
//!
//! ⟨f⟩ = f(c) + ½ S:∇∇f + ⅙ ⟨δδδ⟩⋮∇∇∇f + …, with d² ½ S:∇∇f = n·u (15/2 u·Su − 3/2 tr S)/d² − 3 n·Su/d².
//!
//! Without the cosine, f = 1/|r|², the second term is (4 u·Su − tr S)/d⁴. Colours have centroids of their own, c + δ_c: for
//! each of them the first term is ∇f·δ_c = (n·δ_c − 3 n·u u·δ_c)/d³.

use crate::scene::PointLight;
use glam::DVec3;

/// Share of the third moment, of what colours' second moments differ by, and of the fourth that a pixel sees: the mean
/// over directions and the partial cancellation among nodes.
const SKEW: f64 = 0.8;
/// Distance in radii at which the terms beyond the second are taken; a node is opened from nearer than 1.2, and one
/// accepted from farther than 4 has next to no error.
const REFERENCE: f64 = 2.0;

/// Sums over lights, about the centroid of their power.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub(super) center: DVec3,
    pub(super) intensity: [f64; 3],
    // By channel: Σ I δ, and Σ I δδ as xx yy zz, xy xz yz.
    first: [DVec3; 3],
    second: [[DVec3; 2]; 3],
    // Σ P δδδ: xxx yyy zzz, xxy xxz yyx, yyz zzx zzy, xyz.
    third: [f64; 10],
    // Σ P |δ|⁴.
    fourth: f64,
}

impl Sums {
    /// Of the lights themselves.
    pub(super) fn of_lights(lights: &[PointLight]) -> Self {
        let place = |light: &PointLight| light.position.as_dvec3();
        let power = |light: &PointLight| f64::from(light.intensity.element_sum()) / 3.0;
        let center = centroid(lights.iter().map(|light| (power(light), place(light))));
        let mut sums = Self { center, ..Self::default() };
        for light in lights {
            let point = Self {
                center: place(light),
                intensity: light.intensity.to_array().map(f64::from),
                ..Self::default()
            };
            sums.add(&point);
        }
        sums
    }

    /// Of nodes, from theirs.
    pub(super) fn of_parts(parts: &[Self]) -> Self {
        let center = centroid(parts.iter().map(|part| (part.power(), part.center)));
        let mut sums = Self { center, ..Self::default() };
        parts.iter().for_each(|part| sums.add(part));
        sums
    }

    /// Mean of the channels' intensities.
    pub(super) fn power(&self) -> f64 {
        self.intensity.iter().sum::<f64>() / 3.0
    }

    /// Adds sums about another centre: the shift theorem, channel by channel.
    fn add(&mut self, part: &Self) {
        let s = part.center - self.center;
        let (ss, sss) = (products(s), triple(s));
        let mut power_first = DVec3::ZERO;
        let mut power_second = [DVec3::ZERO; 2];
        for c in 0..3 {
            let (i, d, q) = (part.intensity[c], part.first[c], part.second[c]);
            self.intensity[c] += i;
            self.first[c] += d + i * s;
            // δ → δ + s: δδ + δs + sδ + ss.
            self.second[c][0] += q[0] + 2.0 * d * s + i * ss[0];
            let cross = DVec3::new(d.x * s.y + d.y * s.x, d.x * s.z + d.z * s.x, d.y * s.z + d.z * s.y);
            self.second[c][1] += q[1] + cross + i * ss[1];
            power_first += d / 3.0;
            power_second = [power_second[0] + q[0] / 3.0, power_second[1] + q[1] / 3.0];
        }
        let power = part.power();
        let of_second = mixed_triple(power_second, s);
        // Symmetric in its three factors: δss is ssδ.
        let of_first = mixed_triple(ss, power_first);
        for (i, sum) in self.third.iter_mut().enumerate() {
            *sum += part.third[i] + of_second[i] + of_first[i] + power * sss[i];
        }
        // |δ + s|⁴ without its odd terms, which cancel between the parts of a node.
        let (s2, trace) = (s.length_squared(), power_second[0].element_sum());
        let along = s.dot(apply(power_second, s));
        self.fourth += part.fourth + 2.0 * s2 * trace + 4.0 * along + power * s2 * s2;
    }

    /// Of power: xx yy zz, and xy xz yz.
    pub(super) fn covariance(&self) -> [DVec3; 2] {
        let scale = reciprocal(3.0 * self.power());
        let sum = |part: usize| self.second.iter().map(|second| second[part]).sum::<DVec3>();
        [(sum(0) * scale).max(DVec3::ZERO), sum(1) * scale]
    }

    /// From the centroid of power to each channel's.
    pub(super) fn shifts(&self) -> [DVec3; 3] {
        [0, 1, 2].map(|c| self.first[c] * reciprocal(self.intensity[c]))
    }

    /// Relative error of a node of that radius: the coefficient of (radius/d)³. Where the horizon cuts a node each pixel looks
    /// for itself (glsl/direct/cut.frag).
    pub(super) fn error(&self, radius: f64) -> f64 {
        if radius <= 0.0 || self.power() <= 0.0 {
            return 0.0;
        }
        let [diagonal, mixed] = self.covariance();
        let colors = (0..3).map(|c| {
            let scale = reciprocal(self.intensity[c]);
            // A channel that is black has nothing to be wrong.
            let off = if scale > 0.0 { 1.0 } else { 0.0 };
            let q = self.second[c];
            norm(off * (q[0] * scale - diagonal), off * (q[1] * scale - mixed))
        });
        let colors = colors.fold(0.0, f64::max) / radius.powi(2);
        let third = triple_norm(&self.third) / self.power() / radius.powi(3);
        let fourth = self.fourth / self.power() / radius.powi(4);
        SKEW * (colors * REFERENCE + third + fourth / REFERENCE)
    }
}

/// 0 for nothing.
fn reciprocal(x: f64) -> f64 {
    if x > 0.0 { 1.0 / x } else { 0.0 }
}

/// Of weights and places; where all weights are 0, of the places.
fn centroid(weighted: impl Iterator<Item = (f64, DVec3)> + Clone) -> DVec3 {
    let total: f64 = weighted.clone().map(|(weight, _)| weight).sum();
    let count = weighted.clone().count() as f64;
    weighted.map(|(weight, place)| place * if total > 0.0 { weight / total } else { 1.0 / count }).sum()
}

fn products(s: DVec3) -> [DVec3; 2] {
    [s * s, DVec3::new(s.x * s.y, s.x * s.z, s.y * s.z)]
}

/// A symmetric matrix times a vector.
fn apply([diagonal, mixed]: [DVec3; 2], s: DVec3) -> DVec3 {
    DVec3::new(
        diagonal.x * s.x + mixed.x * s.y + mixed.y * s.z,
        mixed.x * s.x + diagonal.y * s.y + mixed.z * s.z,
        mixed.y * s.x + mixed.z * s.y + diagonal.z * s.z,
    )
}

fn triple(s: DVec3) -> [f64; 10] {
    let [x, y, z] = s.to_array();
    [
        x * x * x,
        y * y * y,
        z * z * z,
        x * x * y,
        x * x * z,
        y * y * x,
        y * y * z,
        z * z * x,
        z * z * y,
        x * y * z,
    ]
}

/// The three ways in which a matrix and a vector fill a symmetric tensor, added up.
fn mixed_triple([d, m]: [DVec3; 2], s: DVec3) -> [f64; 10] {
    [
        3.0 * d.x * s.x,
        3.0 * d.y * s.y,
        3.0 * d.z * s.z,
        d.x * s.y + 2.0 * m.x * s.x,
        d.x * s.z + 2.0 * m.y * s.x,
        d.y * s.x + 2.0 * m.x * s.y,
        d.y * s.z + 2.0 * m.z * s.y,
        d.z * s.x + 2.0 * m.y * s.z,
        d.z * s.y + 2.0 * m.z * s.z,
        m.x * s.z + m.y * s.y + m.z * s.x,
    ]
}

/// Frobenius norm of a symmetric matrix.
fn norm(diagonal: DVec3, mixed: DVec3) -> f64 {
    (diagonal.length_squared() + 2.0 * mixed.length_squared()).sqrt()
}

/// Of a symmetric tensor: elements with two equal indices stand for three, the last for six.
fn triple_norm(t: &[f64; 10]) -> f64 {
    let weight = |i: usize| [1.0, 3.0, 6.0][usize::from(i >= 3) + usize::from(i == 9)];
    t.iter().enumerate().map(|(i, v)| weight(i) * v * v).sum::<f64>().sqrt()
}
