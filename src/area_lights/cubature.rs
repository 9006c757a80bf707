//! Points and weights that stand for a light's area.
//!
//! | shape | coarse | fine |
//! | --- | --- | --- |
//! | rectangle, parallelogram | 2 × 2 Gauss, degree 3 in each coordinate | 4 × 4 Gauss, degree 7 |
//! | ellipse | 4 points, degree 3 | 16 points, degree 7 |
//! | polygon | at most 10 points, degree 3 | at most 21 points, degree 5 |
//! | line | 2 Gauss, degree 3 | 6 Gauss, degree 11 |
//!
//! A polygon's rule has as few points however many corners and holes there are: see [`super::compress`]. All points lie
//! inside the light, all weights are positive.

use super::compress::compress;
use super::plane::{Outline, Plane, area};
use glam::DVec2;
use std::f64::consts::{FRAC_PI_4, TAU};

/// A point with its share of the whole, and the part of the light that it stands for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) st: DVec2,
    /// Shares add up to 1.
    pub(super) share: f64,
    pub(super) cell: Cell,
}

/// A part of a light.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cell {
    /// Lower and upper corner.
    Rectangle([DVec2; 2]),
    /// Squared radii and angles, between a lower and an upper corner.
    Sector([DVec2; 2]),
    /// What lies nearest to the point.
    Nearest,
}

/// Which of the two choices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    Coarse,
    Fine,
}

/// Positive half of the nodes of Gauss–Legendre rules on [−1, 1], and their weights.
const GAUSS_2: [[f64; 2]; 1] = [[0.577_350_269_189_625_8, 1.0]];
const GAUSS_4: [[f64; 2]; 2] =
    [[0.339_981_043_584_856_3, 0.652_145_154_862_546_1], [0.861_136_311_594_052_6, 0.347_854_845_137_453_9]];
const GAUSS_6: [[f64; 2]; 3] = [
    [0.238_619_186_083_196_9, 0.467_913_934_572_691],
    [0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
    [0.932_469_514_203_152, 0.171_324_492_379_170_3],
];

/// Nodes in ascending order with shares that add up to 1, and the border above each share.
fn gauss(half: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let lower = half.iter().rev().map(|&[x, w]| [-x, w]);
    let mut border = -1.0;
    let row = |[x, w]: [f64; 2]| {
        border += w;
        [x, 0.5 * w, border]
    };
    lower.chain(half.iter().copied()).map(row).collect()
}

/// Points along a line, from −1 at one end to 1 at the other, with their shares.
pub(super) fn line(choice: Choice) -> Vec<[f64; 2]> {
    let rule = if choice == Choice::Coarse { gauss(&GAUSS_2) } else { gauss(&GAUSS_6) };
    rule.into_iter().map(|[x, share, _]| [x, share]).collect()
}

/// Points of a flat light; `triangles` tile its outline.
pub(super) fn flat(plane: &Plane, triangles: &[[DVec2; 3]], choice: Choice) -> Vec<Node> {
    match &plane.outline {
        Outline::Parallelogram => square(choice),
        Outline::Ellipse => disk(choice),
        Outline::Loops(loops) if is_square(loops) => square(choice),
        Outline::Loops(_) => polygon(triangles, if choice == Choice::Coarse { 3 } else { 5 }),
    }
}

/// A polygon that fills its bounding rectangle.
fn is_square(loops: &[Vec<DVec2>]) -> bool {
    let corner = |st: &DVec2| (st.abs() - DVec2::ONE).abs().max_element() < 1e-6;
    loops.len() == 1 && loops[0].len() == 4 && loops[0].iter().all(corner)
}

fn square(choice: Choice) -> Vec<Node> {
    let rule = if choice == Choice::Coarse { gauss(&GAUSS_2) } else { gauss(&GAUSS_4) };
    let node = |[s, ws, s1]: [f64; 3], [t, wt, t1]: [f64; 3]| Node {
        st: DVec2::new(s, t),
        share: ws * wt,
        cell: Cell::Rectangle([DVec2::new(s1 - 2.0 * ws, t1 - 2.0 * wt), DVec2::new(s1, t1)]),
    };
    rule.iter().flat_map(|&t| rule.iter().map(move |&s| node(s, t))).collect()
}

/// Rings of equal angles at Gauss points of the squared radius, over which area is uniform.
fn disk(choice: Choice) -> Vec<Node> {
    let (angles, squared): (u32, &[f64]) = match choice {
        Choice::Coarse => (4, &[0.5]),
        Choice::Fine => (8, &[0.211_324_865_405_187_1, 0.788_675_134_594_812_9]),
    };
    let rings = squared.len() as f64;
    let node = |(ring, r2): (f64, f64), angle: u32| {
        let width = TAU / f64::from(angles);
        // Off the axes, so that four points are as far from the corners of a box as from its sides.
        let middle = (f64::from(angle) + 0.5) * width;
        Node {
            st: r2.sqrt() * DVec2::from_angle(middle),
            share: 1.0 / (rings * f64::from(angles)),
            cell: Cell::Sector([
                DVec2::new(ring / rings, middle - 0.5 * width),
                DVec2::new((ring + 1.0) / rings, middle + 0.5 * width),
            ]),
        }
    };
    let rings = squared.iter().enumerate().map(|(ring, &r2)| (ring as f64, r2));
    rings.flat_map(|ring| (0..angles).map(move |angle| node(ring, angle))).collect()
}

/// Barycentric orbits and weights of Radon's rule of degree 5 over a triangle: 7 points.
const RADON: [[f64; 2]; 3] = [
    [1.0 / 3.0, 0.225],
    [0.470_142_064_105_115_1, 0.132_394_152_788_506_2],
    [0.101_286_507_323_456_3, 0.125_939_180_544_827_2],
];

fn polygon(triangles: &[[DVec2; 3]], degree: usize) -> Vec<Node> {
    let whole: f64 = triangles.iter().map(|t| area(t)).sum();
    let mut points = Vec::with_capacity(7 * triangles.len());
    for triangle in triangles {
        let share = area(triangle) / whole;
        let [a, b, c] = *triangle;
        points.push(((a + b + c) / 3.0, RADON[0][1] * share));
        for [x, w] in &RADON[1..] {
            let rest = 1.0 - 2.0 * x;
            points.extend(
                [[a, b, c], [b, c, a], [c, a, b]].map(|[p, q, r]| (x * (p + q) + rest * r, w * share)),
            );
        }
    }
    let nodes = compress(points, degree).into_iter();
    nodes.map(|(st, share)| Node { st, share, cell: Cell::Nearest }).collect()
}

/// Area in (s, t).
pub(super) fn area_of(plane: &Plane, triangles: &[[DVec2; 3]]) -> f64 {
    match &plane.outline {
        Outline::Parallelogram => 4.0,
        Outline::Ellipse => 4.0 * FRAC_PI_4,
        Outline::Loops(_) => triangles.iter().map(|t| area(t)).sum(),
    }
}
