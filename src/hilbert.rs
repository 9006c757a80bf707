//! The order of points along a Hilbert curve through their bounds, in linear time unless they crowd into few places.
//!
//! 1. Keys have 12 bits an axis, of which the sort reads 32 in all. They are Skilling's (2004, «Programming the Hilbert
//!    curve»), made three levels at a time by a table of the states that his algorithm can be in.
//! 2. A stable partition by the first 12 bits leaves runs that a core's own cache holds; each is partitioned by as many
//!    more bits as it has points for, and again where points crowd, until 8 are left, which are compared.
//!
//! CPU ms of 2²⁰ points strewn evenly, on one thread: bounds 3, keys 8, sort 10; a radix sort of all 30 bits and tables of
//! two levels took 51. Morton's keys cost as much within 2 %, and boxes of 32 points in their order have 2.7 times the
//! volume (1.6 times with ranges as in `scenes/million.toml`).

use glam::Vec3;
use std::ops::Range;
use std::sync::LazyLock;

/// Bits per axis, a multiple of the levels of a step.
const BITS: u32 = 12;
/// Bits of a key that the sort reads.
const KEY_BITS: u32 = 32;
/// Bits of the first partition.
const FIRST_DIGIT: u32 = 12;
/// Bits of the others at most: their counters stay in the first cache.
const DIGIT: u32 = 10;
/// As many elements are sorted by comparing them.
const FEW: usize = 8;
/// Orientations of the curve.
const STATES: usize = 24;
/// Bits of a state's number.
const STATE_BITS: u32 = 5;
/// Three levels of the curve: `state << 9 | x << 6 | y << 3 | z` to `key << STATE_BITS | next state`. Its length lets no
/// lookup need a check.
type Steps = [u16; 512 << STATE_BITS];

static STEPS: LazyLock<Box<Steps>> = LazyLock::new(|| {
    let states = states();
    let mut steps = Box::new([0; 512 << STATE_BITS]);
    for (number, first) in states.iter().enumerate() {
        for cell in 0..512 {
            let octant = |bit: usize| [cell >> (6 + bit) & 1, cell >> (3 + bit) & 1, cell >> bit & 1];
            let (key, last) = (0..3).rev().fold((0, *first), |(key, state), bit| {
                let (three, next) = state.step(octant(bit));
                (key << 3 | three, next)
            });
            let next = states.iter().position(|state| state.way() == last.way()).unwrap_or(0);
            steps[number << 9 | cell] = (key << STATE_BITS | next) as u16;
        }
    }
    steps
});

/// One state for each way through the octants; the first is that of the whole curve.
fn states() -> Vec<State> {
    let mut states = vec![State { axes: [0, 1, 2], inverted: [0; 3], gray: 0 }];
    let mut next = 0;
    while let Some(state) = states.get(next).copied() {
        for octant in 0..8 {
            let (_, child) = state.step([octant >> 2 & 1, octant >> 1 & 1, octant & 1]);
            if states.iter().all(|known| known.way() != child.way()) {
                states.push(child);
            }
        }
        next += 1;
    }
    debug_assert_eq!(states.len(), STATES, "the ways of a Hilbert curve");
    states
}

/// What the levels above did to the bits below them.
#[derive(Clone, Copy)]
struct State {
    /// Which axis stands in each place; the third place has what is left.
    axes: [usize; 3],
    /// 1 where a place's bits are inverted.
    inverted: [usize; 3],
    /// 1 where the key's are.
    gray: usize,
}

impl State {
    /// The key of each octant.
    fn way(self) -> [usize; 8] {
        std::array::from_fn(|octant| self.step([octant >> 2 & 1, octant >> 1 & 1, octant & 1]).0)
    }

    /// Three bits of the key, and the state of the next level.
    fn step(mut self, octant: [usize; 3]) -> (usize, Self) {
        let bits: [usize; 3] = std::array::from_fn(|i| octant[self.axes[i]] ^ self.inverted[i]);
        for (i, bit) in bits.into_iter().enumerate() {
            if bit == 1 {
                self.inverted[0] ^= 1;
            } else {
                self.axes.swap(0, i);
                self.inverted.swap(0, i);
            }
        }
        let gray = [bits[0], bits[0] ^ bits[1], bits[0] ^ bits[1] ^ bits[2]];
        let key = gray.iter().fold(0, |key, bit| key << 1 | (bit ^ self.gray));
        self.gray ^= gray[2];
        (key, self)
    }
}

/// Indices of the points in the curve's order; points in one place keep theirs. A few that lie far from all others come
/// last, along a curve of their own, so that the others' has cells of their size.
#[must_use]
pub fn order(points: impl ExactSizeIterator<Item = Vec3> + Clone) -> Vec<u32> {
    let bulk = bulk(points.clone());
    let inside = |p: Vec3| bulk[0].cmple(p).all() && p.cmple(bulk[1]).all();
    if bounds(points.clone()).into_iter().all(inside) {
        return along_curve(points);
    }
    let places: Vec<Vec3> = points.collect();
    let (near, far): (Vec<u32>, Vec<u32>) =
        (0..places.len() as u32).partition(|&index| inside(places[index as usize]));
    [near, far].into_iter().flat_map(|part| sub_order(&places, &part)).collect()
}

/// A part of all indices in the order of a curve through their points.
fn sub_order(places: &[Vec3], part: &[u32]) -> Vec<u32> {
    let own: Vec<Vec3> = part.iter().map(|&index| places[index as usize]).collect();
    along_curve(own.iter().copied()).into_iter().map(|at| part[at as usize]).collect()
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
    points.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[lower, upper], p| [lower.min(p), upper.max(p)])
}

/// As [`order`], in one curve. Points that crowd into one cell are ordered along a curve through their own bounds.
fn along_curve(points: impl ExactSizeIterator<Item = Vec3> + Clone) -> Vec<u32> {
    let elements = sorted(points.clone());
    let mut order: Vec<u32> = elements.iter().map(|&element| element as u32).collect();
    let mut places = Vec::new();
    let mut begin = 0;
    for cell in elements.chunk_by(|a, b| a >> 32 == b >> 32) {
        let within = begin..begin + cell.len();
        begin = within.end;
        if cell.len() <= FEW || cell.len() == elements.len() {
            continue;
        }
        if places.is_empty() {
            places.extend(points.clone());
        }
        let along = sub_order(&places, &order[within.clone()]);
        order[within].copy_from_slice(&along);
    }
    order
}

/// Keys and indices of the points, sorted by the keys but for [`FEW`] together.
fn sorted(points: impl ExactSizeIterator<Item = Vec3> + Clone) -> Vec<u64> {
    let [lower, upper] = bounds(points.clone());
    // Halves, so that no difference of numbers is infinite.
    let extent = (0.5 * upper - 0.5 * lower).max_element();
    // The far corner still falls into a cell.
    let scale = (0.5 * ((1 << BITS) - 4) as f32 / extent).min(f32::MAX);
    let steps = &**STEPS;
    let mut elements: Vec<u64> = Vec::with_capacity(points.len());
    elements
        .extend(points.zip(0..).map(|(p, index)| u64::from(key(steps, (p - lower) * scale)) << 32 | index));
    let mut other = vec![0; elements.len()];
    let mut ends = vec![0; 1 << FIRST_DIGIT];
    partition(&elements, &mut other, KEY_BITS - FIRST_DIGIT, &mut ends);
    for run in runs(&ends) {
        refine(&mut other[run.clone()], &mut elements[run], KEY_BITS - FIRST_DIGIT);
    }
    elements
}

/// Sorts `from` into `into`, by the last `bits` bits of the keys; the others are equal.
fn refine(from: &mut [u64], into: &mut [u64], bits: u32) {
    if from.len() <= FEW || bits == 0 {
        into.copy_from_slice(from);
        into.sort_unstable();
        return;
    }
    // Two to four points a run where they are strewn evenly.
    let digit = (from.len().ilog2() - 1).min(DIGIT).min(bits);
    let mut ends = [0; 1 << DIGIT];
    let ends = &mut ends[..1 << digit];
    partition(from, into, bits - digit, ends);
    for run in runs(ends).filter(|run| run.len() > 1) {
        if run.len() <= FEW {
            into[run].sort_unstable();
        } else {
            refine(&mut into[run.clone()], &mut from[run.clone()], bits - digit);
            into[run.clone()].copy_from_slice(&from[run]);
        }
    }
}

/// Copies `from` to `to` in the order of the keys' bits from bit `shift` on, of which `ends` has one number for each value:
/// zeros, and afterwards where the run with that value ends. Equal ones keep their order.
fn partition(from: &[u64], to: &mut [u64], shift: u32, ends: &mut [u32]) {
    let mask = ends.len() - 1;
    let digit = |element: u64| (element >> (32 + shift)) as usize & mask;
    for &element in from {
        ends[digit(element)] += 1;
    }
    let mut first = 0;
    for end in ends.iter_mut() {
        (first, *end) = (first + *end, first);
    }
    for &element in from {
        let place = &mut ends[digit(element)];
        to[*place as usize] = element;
        *place += 1;
    }
}

/// Places of the runs that are not empty.
fn runs(ends: &[u32]) -> impl Iterator<Item = Range<usize>> {
    let begins = std::iter::once(0).chain(ends.iter().copied());
    begins.zip(ends).map(|(begin, &end)| begin as usize..end as usize).filter(|run| !run.is_empty())
}

/// The first bits of the place along the curve of a point of [0, 2^BITS − 1]³.
fn key(steps: &Steps, p: Vec3) -> u32 {
    // Added to 2²³ a float's last bits are the integer: a conversion with its checks costs three times as much.
    let [x, y, z] = p.to_array().map(|v| ((v - 0.5).max(0.0) + 8_388_608.0).to_bits());
    let mut state = 0;
    let mut key = 0_u64;
    for level in (0..BITS).step_by(3).rev() {
        let three = |axis: u32| (axis >> level & 7) as usize;
        let step = usize::from(steps[state << 9 | three(x) << 6 | three(y) << 3 | three(z)]);
        key = key << 9 | (step >> STATE_BITS) as u64;
        state = step & ((1 << STATE_BITS) - 1);
    }
    (key >> (3 * BITS - KEY_BITS)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_space() {
        // 16³ cells, four levels: every cell once, each beside the last.
        let mut cells = vec![None; 4096];
        for i in 0..4096_u32 {
            let p = Vec3::new((i & 15) as f32, (i >> 4 & 15) as f32, (i >> 8) as f32);
            let place = &mut cells[(key(&STEPS, p * 256.0 + 0.5) >> 20) as usize];
            assert!(place.replace(p).is_none());
        }
        for pair in cells.windows(2) {
            let [a, b] = [pair[0].unwrap(), pair[1].unwrap()];
            assert_eq!((a - b).abs().element_sum(), 1.0, "{a} {b}");
        }
    }

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
