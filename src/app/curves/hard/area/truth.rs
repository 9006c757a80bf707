//! Form factors in double precision by a way of their own: the contour above the horizon, edges by their sines and arcs by
//! adaptive quadrature, and the horizon between them.

use crate::ltc::leak;
use glam::{DMat3, DVec3, DVec4};
use std::f64::consts::TAU;

/// center + a cos ψ + b sin ψ for ψ from the first to the second of `range`.
struct Arc {
    center: DVec3,
    a: DVec3,
    b: DVec3,
    range: [f64; 2],
}

/// A part of a contour above the horizon: its ends, and what it adds.
struct Part {
    ends: [DVec3; 2],
    sum: f64,
}

/// 2π times what an edge adds; nothing where it passes through the point.
fn edge_sum(a: DVec3, b: DVec3) -> f64 {
    let c = a.cross(b - a);
    let sine = c.length();
    if sine > 0.0 { -c.z * sine.atan2(a.dot(b)) / sine } else { 0.0 }
}

fn edge([a, b]: [DVec3; 2]) -> Option<Part> {
    let on_horizon = || ((a * b.z.abs() + b * a.z.abs()) / (a.z.abs() + b.z.abs())).with_z(0.0);
    let ends = match [a.z >= 0.0, b.z >= 0.0] {
        [true, true] => [a, b],
        [true, false] => [a, on_horizon()],
        [false, true] => [on_horizon(), b],
        [false, false] => return None,
    };
    Some(Part { ends, sum: edge_sum(ends[0], ends[1]) })
}

impl Arc {
    fn at(&self, psi: f64) -> DVec3 {
        self.center + psi.cos() * self.a + psi.sin() * self.b
    }

    /// Derivative.
    fn step(&self, psi: f64) -> DVec3 {
        psi.cos() * self.b - psi.sin() * self.a
    }

    /// What is above the horizon, in order.
    fn parts(&self) -> Vec<Part> {
        let height = self.a.z.hypot(self.b.z);
        let [from, to] = self.range;
        let mut ends = vec![from, to];
        if self.center.z.abs() < height {
            let (middle, half) = (self.b.z.atan2(self.a.z), (-self.center.z / height).acos());
            let turns = (-3..=3).map(|turn| TAU * f64::from(turn) + middle);
            let crossings = turns.flat_map(|middle| [middle - half, middle + half]);
            ends.extend(crossings.filter(|&psi| from.min(to) < psi && psi < from.max(to)));
            ends.sort_by(|x, y| if from < to { x.total_cmp(y) } else { y.total_cmp(x) });
        }
        let part = |pair: &[f64]| {
            let above = self.at(0.5 * (pair[0] + pair[1])).z > 0.0;
            let ends = [self.at(pair[0]), self.at(pair[1])];
            above.then(|| Part { ends, sum: self.sum([pair[0], pair[1]], self.gauss([pair[0], pair[1]]), 0) })
        };
        ends.windows(2).filter_map(part).collect()
    }

    /// Halved until both halves are the whole, to the rounding of what is summed.
    fn sum(&self, [from, to]: [f64; 2], whole: f64, depth: u32) -> f64 {
        let middle = 0.5 * (from + to);
        let halves = [[from, middle], [middle, to]];
        let sums = halves.map(|half| self.gauss(half));
        let (r, step) = (self.at(middle), self.step(middle));
        let rounding = 1e-13 * (to - from).abs() * step.length() / r.length();
        let settled = (sums[0] + sums[1] - whole).abs() <= rounding;
        if depth >= 2 && (settled || depth > 24) {
            return sums[0] + sums[1];
        }
        (0..2).map(|i| self.sum(halves[i], sums[i], depth + 1)).sum()
    }

    /// With 8 points.
    fn gauss(&self, [from, to]: [f64; 2]) -> f64 {
        const RULE: [(f64, f64); 4] = [
            (0.183_434_642_495_649_8, 0.362_683_783_378_362),
            (0.525_532_409_916_329, 0.313_706_645_877_887_3),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
        ];
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let value = |psi: f64| {
            let (r, step) = (self.at(psi), self.step(psi));
            -r.cross(step).z / r.length_squared()
        };
        RULE.iter().map(|&(x, w)| w * half * (value(middle - half * x) + value(middle + half * x))).sum()
    }
}

/// A closed contour, of which parts may be missing below the horizon.
fn closed(parts: &[Part]) -> f64 {
    let next = parts.iter().cycle().skip(1);
    let sum = |(part, next): (&Part, &Part)| part.sum + edge_sum(part.ends[1], next.ends[0]);
    parts.iter().zip(next).map(sum).sum::<f64>() / TAU
}

/// Positive where the ring is counter-clockwise seen from the point.
pub(super) fn polygon(ring: &[DVec3]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let parts: Vec<Part> = ring.iter().zip(next).filter_map(|(&a, &b)| edge([a, b])).collect();
    closed(&parts)
}

/// Of center and half axes.
pub(super) fn ellipse([center, a, b]: [DVec3; 3]) -> f64 {
    closed(&Arc { center, a, b, range: [0.0, TAU] }.parts()).abs()
}

/// An open cylinder: the strip between the tangent planes, and its rims between.
pub(super) fn cylinder([from, to]: [DVec3; 2], radius: f64) -> f64 {
    let Some(axis) = (to - from).try_normalize() else { return 0.0 };
    let foot = from - axis * from.dot(axis);
    let d = foot.length();
    if d <= radius {
        return 0.0;
    }
    let (out, half) = (-foot / d, (radius / d).acos());
    let side = axis.cross(out);
    let rim = |center: DVec3, range: [f64; 2]| Arc { center, a: radius * out, b: radius * side, range };
    let [first, last] = [rim(from, [-half, half]), rim(to, [half, -half])];
    let mut parts = first.parts();
    parts.extend(edge([first.at(half), last.at(half)]));
    parts.extend(last.parts());
    parts.extend(edge([last.at(-half), first.at(-half)]));
    closed(&parts).abs()
}

/// What of a transformed cosine is above the surface, by view, shape and stretch: what a furnace gives back.
pub(super) fn furnace([wo, shape, stretch]: [DVec4; 3]) -> f64 {
    let wo = wo.truncate();
    let y = DVec3::new(-wo.y, wo.x, 0.0).try_normalize().unwrap_or(DVec3::Y);
    let z = DVec3::new(-wo.x, -wo.y, wo.z);
    let frame = DMat3::from_cols(y.cross(z), y, z);
    let [a, b, c, d] = [shape.x, stretch.x * shape.y, stretch.x * shape.z, stretch.x * shape.w];
    1.0 - leak(&(DMat3::from_cols_array(&[a, 0.0, c, 0.0, 1.0, 0.0, b, 0.0, d]) * frame.transpose()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn near(got: f64, want: f64, most: f64) {
        assert!((got - want).abs() <= most, "{got} for {want}");
    }

    /// A unit square 1 over the point by its corner, a wall of 2 × 1 that stands 1 away, ever deeper in the ground, and the
    /// octant's triangle: ¼.
    #[test]
    fn polygons() {
        let ring = |points: &[[f64; 3]]| polygon(&points.iter().map(|&p| p.into()).collect::<Vec<_>>());
        near(ring(&[[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]]), 0.138_531_606, 1e-9);
        for foot in [0.0, -0.5, -7.0] {
            let wall = [[1., -1., foot], [1., -1., 1.], [1., 1., 1.], [1., 1., foot]];
            near(ring(&wall), 0.111_468_394, 1e-9);
        }
        near(ring(&[[0., 0., 1.], [0., 1., 0.], [1., 0., 0.]]), 0.25, 1e-12);
    }

    /// A level disk 1 up: ½ for a unit disk overhead, R²/(R² + 1) for others; then aside. And a sphere of R/d = .9 on the
    /// horizon, which covers what its disk does.
    #[test]
    fn disks() {
        let disk = |aside: f64, r: f64| ellipse([DVec3::new(aside, 0., 1.), DVec3::X * r, DVec3::Y * r]);
        for (aside, r, want) in [
            (0.0, 1.0, 0.5),
            (0.0, 0.1, 0.009_900_990_1),
            (0.0, 10.0, 0.990_099_01),
            (1.0, 1.0, 0.276_393_202),
            (2.0, 1.0, 0.052_786_405),
        ] {
            near(disk(aside, r), want, 1e-8 * want);
        }
        let tangent = 0.9 / (1.0_f64 - 0.81).sqrt();
        near(ellipse([DVec3::X, DVec3::Y * tangent, DVec3::Z * tangent]), 0.231_560_450, 1e-9);
        near(ellipse([DVec3::NEG_Z, DVec3::X, DVec3::Y]), 0.0, 0.0);
    }

    /// Level ones of half length l and d up: a line's form factor, and l d R²/(d² + l²)² for the nearer halves of the rims,
    /// which bulge beyond its ends by l R cos ψ/d at R sin ψ aside. From inside nothing, nor without length.
    #[test]
    fn cylinders() {
        let ends = |l: f64, d: f64| [DVec3::new(-l, 0., d), DVec3::new(l, 0., d)];
        for (l, d) in [(1.0, 1.0), (1.0, 0.5), (1.0, 0.2), (0.3, 1.0)] {
            for radius in [1e-2 * d, 1e-3 * d, 1e-4 * d] {
                let ends2: f64 = d * d + l * l;
                let line = 2.0 / PI * radius * (l / ends2 + (l / d).atan() / d);
                let bulge = l * d * radius * radius / (ends2 * ends2);
                // Terms of the next order.
                let rest = (radius / d).powi(2) * line;
                near(cylinder(ends(l, d), radius), line + bulge, 2.0 * rest);
            }
        }
        near(cylinder(ends(1.0, 1.0), 1.1), 0.0, 0.0);
        near(cylinder([DVec3::Z; 2], 0.1), 0.0, 0.0);
    }
}
