//! Form factors in double precision by other ways than the shader's: rings clipped as lists (Sutherland and Hodgman),
//! contours and surfaces by quadrature.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use crate::probe::{Cylinder, Ellipse, Outline};

/// A sequence of numbers that is the same on every run (SplitMix64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }

    /// In [0, 1).
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// By equal ratios.
    pub(crate) fn ratio(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }

    pub(crate) fn choice(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    /// In the cube [−1, 1]³.
    pub(crate) fn cube(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        let (z, phi) = (self.between(-1.0, 1.0), self.between(0.0, TAU));
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * phi.cos(), r * phi.sin(), z)
    }
}

pub(crate) fn outline(outline: &Outline) -> f64 {
    outline.exact().iter().map(|exact| ring(exact)).sum()
}

pub(crate) fn ring(ring: &[DVec3]) -> f64 {
    lambert(&above(ring))
}

/// Sutherland and Hodgman's clip to z ≥ 0.
fn above(ring: &[DVec3]) -> Vec<DVec3> {
    let mut kept = vec![];
    for (a, b) in edges(ring) {
        if a.z >= 0.0 {
            kept.push(a);
        }
        if (a.z >= 0.0) != (b.z >= 0.0) {
            kept.push(a.lerp(b, a.z / (a.z - b.z)).with_z(0.0));
        }
    }
    kept
}

fn edges(ring: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// Positive where the ring is counter-clockwise seen from the origin.
fn lambert(ring: &[DVec3]) -> f64 {
    let term = |(a, b): (DVec3, DVec3)| {
        let c = a.cross(b - a);
        let sine = c.length();
        if sine > 0.0 { -c.z * sine.atan2(a.dot(b)) / sine } else { 0.0 }
    };
    edges(ring).map(term).sum::<f64>() / TAU
}

/// How much more an outline's form factor moves than its vertices, both relative: an edge that passes near the origin, and
/// the chord along the horizon, turn about it. No bound where one goes through the origin.
pub(crate) fn sensitivity(outline: &Outline) -> f64 {
    let of_edge = |(a, b): (DVec3, DVec3)| {
        let reach = a.length().min(b.length()) * (b - a).length();
        reach / a.cross(b).length().max(1e-30)
    };
    let rings = outline.exact();
    let worst = |ring: &[DVec3]| edges(ring).filter(|(a, b)| a != b).map(of_edge).fold(0.0, f64::max);
    rings.iter().map(|ring| worst(ring).max(worst(&above(ring)))).fold(0.0, f64::max)
}

/// Nodes and weights of Gauss and Legendre on [−1, 1].
fn legendre<const N: usize>() -> [(f64, f64); N] {
    std::array::from_fn(|i| {
        let mut x = (PI * (i as f64 + 0.75) / (N as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut p, mut previous) = (x, 1.0);
            for k in 2..=N {
                let k = k as f64;
                (p, previous) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k, p);
            }
            slope = N as f64 * (x * p - previous) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// The outline's arc above the horizon by panels that shrink towards the two points of it nearest the origin, and the
/// chord. Unsigned.
pub(crate) fn ellipse(ellipse: &Ellipse) -> f64 {
    let [c, a, b] = [ellipse.center, ellipse.a, ellipse.b].map(|v| v.as_dvec3());
    let h = a.z.hypot(b.z);
    if c.z <= -h {
        return 0.0;
    }
    let whole = c.z >= h;
    let half = if whole { PI } else { (-c.z / h).acos() };
    let begin = if whole { 0.0 } else { b.z.atan2(a.z) } - half;
    let at = |x: f64| ellipse.point(begin + 2.0 * half * x);
    let panels = panels(|x| at(x).length_squared());
    let rule = legendre::<16>();
    let mut sum = 0.0;
    for pair in panels.windows(2) {
        let (middle, reach) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        for (x, weight) in rule {
            let psi = begin + 2.0 * half * (middle + reach * x);
            let p = ellipse.point(psi);
            let derivative = psi.cos() * b - psi.sin() * a;
            let step = 2.0 * half * weight * reach;
            sum += step * (p.x * derivative.y - p.y * derivative.x) / p.length_squared();
        }
    }
    let (from, to) = (at(1.0), at(0.0));
    let chord = if whole { 0.0 } else { from.cross(to).z.atan2(from.dot(to)) };
    (sum + chord).abs() / TAU
}

/// Ends of panels over [0, 1]: even ones, and graded ones towards the least value of f and the least far from it.
fn panels(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let samples: Vec<_> = (0..=256).map(|i| f64::from(i) / 256.0).collect();
    let least = |far_from: Option<f64>| {
        let allowed = samples.iter().filter(|&&x| far_from.is_none_or(|other| (x - other).abs() > 0.1));
        let coarse = *allowed.min_by(|&&x, &&y| f(x).total_cmp(&f(y))).unwrap();
        let mut bracket = [(coarse - 1.0 / 256.0).max(0.0), (coarse + 1.0 / 256.0).min(1.0)];
        for _ in 0..80 {
            let width = (bracket[1] - bracket[0]) / 3.0;
            let [left, right] = [bracket[0] + width, bracket[1] - width];
            bracket = if f(left) < f(right) { [bracket[0], right] } else { [left, bracket[1]] };
        }
        0.5 * (bracket[0] + bracket[1])
    };
    let first = least(None);
    let mut ends: Vec<f64> = (0..=24).map(|i| f64::from(i) / 24.0).collect();
    for minimum in [first, least(Some(first))] {
        ends.push(minimum);
        for i in 0..50 {
            let shrink = 0.6_f64.powi(i);
            ends.extend([minimum * (1.0 - shrink), minimum + (1.0 - minimum) * shrink]);
        }
    }
    ends.sort_by(f64::total_cmp);
    ends
}

/// The visible strip of the surface by quadrature; where it crosses the horizon the kinks cost digits: 1e-6.
pub(crate) fn cylinder(cylinder: &Cylinder) -> f64 {
    let [a, b] = [cylinder.a, cylinder.b].map(|v: Vec3| v.as_dvec3());
    let radius = f64::from(cylinder.radius);
    let axis = (b - a).normalize();
    let perpendicular = a - axis * a.dot(axis);
    let d = perpendicular.length();
    if d <= radius {
        return 0.0;
    }
    let out = -perpendicular / d;
    let side = axis.cross(out);
    let half = (radius / d).acos();
    let foot = (-a.dot(axis) / (b - a).length()).clamp(0.0, 1.0);
    let rule = legendre::<16>();
    // Around: substituted so that the nodes crowd at the tangents. Along: graded towards the foot of the origin.
    let along: Vec<f64> = {
        let mut ends: Vec<f64> = (0..=16).map(|i| f64::from(i) / 16.0).collect();
        for i in 0..30 {
            let shrink = 0.6_f64.powi(i);
            ends.extend([foot * (1.0 - shrink), foot + (1.0 - foot) * shrink]);
        }
        ends.sort_by(f64::total_cmp);
        ends
    };
    let mut sum = 0.0;
    for panel in 0..24 {
        for (x, weight_around) in rule {
            let t = (f64::from(panel) + 0.5 + 0.5 * x) / 24.0;
            let phi = half * (2.0 * t - 1.0);
            let normal = phi.cos() * out + phi.sin() * side;
            for pair in along.windows(2) {
                let (middle, reach) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
                for (y, weight_along) in rule {
                    let p = a.lerp(b, middle + reach * y) + radius * normal;
                    let r2 = p.length_squared();
                    let area = weight_along * reach * (b - a).length() * weight_around * half * radius / 24.0;
                    sum += area * (-normal.dot(p)).max(0.0) * p.z.max(0.0) / (PI * r2 * r2);
                }
            }
        }
    }
    sum
}
