//! The order of points along a Hilbert curve through their bounds, in linear time unless they crowd into few places.
//!
//! 1. Keys have 12 bits an axis, of which the sort reads 32 in all. They are Skilling's (2004, «Programming the Hilbert
//!    curve»), made three levels at a time by a table of the states that his algorithm can be in.
//! 2. A stable partition by the first 12 bits leaves runs that a core's own cache holds; each is partitioned by as many
//!    more bits as it has points for, and again where points crowd. An insertion from neighbour to neighbour does the rest.
//!
//! CPU ms of 2²⁰ points strewn evenly, on one thread of a busy Xeon: 32 as lights, of which 5 are the system's for fresh
//! memory, and 23 as positions alone, whose order takes 84 on lavapipe (`passes::order`). Keys made one by one, and runs each
//! sorted, took 56 there and 21 on an idle EPYC, where a radix sort of all 30 bits and tables of two levels took 51, and
//! Morton's keys as much as these within 2 %; boxes of 32 points in Morton's order have 2.7 times the volume (1.6 times with
//! ranges as in `scenes/million.toml`).

mod curve;
pub(crate) mod sort;

use curve::Grid;
use glam::{Vec3, Vec3A};

/// Indices of the points in the curve's order; points in one place keep theirs. A few that lie far from all others come
/// last, along a curve of their own, so that the others' has cells of their size.
#[must_use]
pub fn order(points: impl ExactSizeIterator<Item = Vec3> + Clone) -> Vec<u32> {
    let bulk = bulk(points.clone());
    let inside = |p: Vec3| bulk[0].cmple(p).all() && p.cmple(bulk[1]).all();
    let bounds = bounds(points.clone());
    if bounds.into_iter().all(inside) {
        return along_curve(points, bounds);
    }
    let places: Vec<Vec3> = points.collect();
    let (near, far): (Vec<u32>, Vec<u32>) =
        (0..places.len() as u32).partition(|&index| inside(places[index as usize]));
    [near, far].into_iter().flat_map(|part| sub_order(&places, &part)).collect()
}

/// The cells of one curve through all points.
pub(crate) fn grid(points: impl Iterator<Item = Vec3>) -> Grid {
    Grid::over(bounds(points))
}

/// The table that their keys are made by, two entries a word, the first in the lower half.
pub(crate) fn steps() -> Vec<u32> {
    curve::STEPS.chunks_exact(2).map(|two| u32::from(two[1]) << 16 | u32::from(two[0])).collect()
}

/// A part of all indices in the order of a curve through their points.
fn sub_order(places: &[Vec3], part: &[u32]) -> Vec<u32> {
    let own: Vec<Vec3> = part.iter().map(|&index| places[index as usize]).collect();
    along_curve(own.iter().copied(), bounds(own.iter().copied()))
        .into_iter()
        .map(|at| part[at as usize])
        .collect()
}

/// A box around all but a few far points: the 5th to the 95th percentile of a sample, and twice that on every side.
fn bulk(points: impl ExactSizeIterator<Item = Vec3>) -> [Vec3; 2] {
    let stride = (points.len() / 1024).max(1);
    let mut sample: Vec<Vec3> = points.step_by(stride).collect();
    if sample.len() < 64 {
        return [Vec3::NEG_INFINITY, Vec3::INFINITY];
    }
    let mut percentile = |percent: usize| {
        let rank = sample.len() * percent / 100;
        Vec3::from_array(std::array::from_fn(|axis| {
            sample.select_nth_unstable_by(rank, |a, b| a[axis].total_cmp(&b[axis])).1[axis]
        }))
    };
    let (low, high) = (percentile(5), percentile(95));
    let margin = 2.0 * (high - low).max_element();
    [low - margin, high + margin]
}

/// Least and largest coordinates.
fn bounds(points: impl Iterator<Item = Vec3>) -> [Vec3; 2] {
    let start = [Vec3A::INFINITY, Vec3A::NEG_INFINITY];
    points.map(Vec3A::from).fold(start, |[lower, upper], p| [lower.min(p), upper.max(p)]).map(Vec3::from)
}

/// As [`order`], in one curve through those bounds. Points that crowd into one cell are ordered along a curve through their
/// own bounds.
fn along_curve(points: impl ExactSizeIterator<Item = Vec3> + Clone, bounds: [Vec3; 2]) -> Vec<u32> {
    let (mut order, crowds) = sort::sort(Grid::over(bounds).keys(points.clone()));
    let all = order.len();
    let mut places = Vec::new();
    for within in crowds.into_iter().filter(|crowd| crowd.len() < all) {
        if places.is_empty() {
            places.extend(points.clone());
        }
        let along = sub_order(&places, &order[within.clone()]);
        order[within].copy_from_slice(&along);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_is_a_permutation_and_stable() {
        let points: Vec<Vec3> = (0..10_000_u32)
            .map(|i| Vec3::new((i * 7919 % 97) as f32, (i * 104_729 % 89) as f32, (i % 3) as f32))
            .collect();
        let order = order(points.iter().copied());
        let mut seen = vec![false; points.len()];
        for &index in &order {
            assert!(!std::mem::replace(&mut seen[index as usize], true));
        }
        for pair in order.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            assert!(points[a as usize] != points[b as usize] || a < b);
        }
    }

    /// Points strewn evenly over a cube of that side.
    fn strewn(side: f32) -> Vec<Vec3> {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        (0..16_384).map(|_| Vec3::new(next(), next(), next()) * side).collect()
    }

    /// Volume of the boxes of 32 points each in that order, relative to the cube's of that side.
    fn boxes(points: &[Vec3], order: &[u32], side: f32) -> f32 {
        let volume = |part: &[u32]| {
            let places = || part.iter().map(|&index| points[index as usize]);
            (places().fold(Vec3::MIN, Vec3::max) - places().fold(Vec3::MAX, Vec3::min)).element_product()
        };
        order.chunks(32).map(volume).sum::<f32>() / side.powi(3)
    }

    #[test]
    fn points_in_order_are_close_however_they_are_strewn() {
        // Of 32 points in a box of its own each the box would be (31/33)³ = 0.83; of random ones, 500.
        let mut points = strewn(1.0);
        let even = boxes(&points, &order(points.iter().copied()), 1.0);
        assert!((0.83..2.5).contains(&even), "{even}");
        // Morton's order jumps: 2.7 times that.
        let bits = |v: f32| (0..10).fold(0_u32, |bits, i| bits | ((v * 1024.0) as u32 >> i & 1) << (3 * i));
        let morton = |&index: &u32| {
            let [x, y, z] = points[index as usize].to_array().map(bits);
            x << 2 | y << 1 | z
        };
        let mut other: Vec<u32> = (0..points.len() as u32).collect();
        other.sort_by_key(morton);
        let worse = boxes(&points, &other, 1.0) / even;
        assert!((2.0..3.5).contains(&worse), "{worse}");
        // A crowd that has 40 cells of the curve along each axis.
        points = strewn(0.01);
        points.push(Vec3::ONE);
        let far = order(points.iter().copied());
        let crowd = boxes(&points, &far[..points.len() - 1], 0.01);
        assert!((0.83..2.5).contains(&crowd), "{crowd}");
    }

    #[test]
    fn points_without_an_extent_keep_their_order() {
        assert!(order([].into_iter()).is_empty());
        assert_eq!(order([Vec3::splat(3.0); 40].into_iter()), (0..40).collect::<Vec<_>>());
        for size in [f32::MIN_POSITIVE, 1e-45, 1e30, f32::MAX] {
            let mut order = order((0..40).map(|i| Vec3::splat(if i % 2 == 0 { size } else { -size })));
            order.sort_unstable();
            assert_eq!(order, (0..40).collect::<Vec<_>>());
        }
    }
}
