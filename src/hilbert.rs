//! The order of points along a Hilbert curve through their bounds, in linear time.
//!
//! Keys have 10 bits an axis, made two levels at a time by a table of the curve's 24 orientations (Hamilton 2006,
//! «Compact Hilbert indices», sections 2.1 to 2.3). A stable radix sort of three passes orders them.

use glam::Vec3;
use std::sync::LazyLock;

/// Bits per axis.
const BITS: u32 = 10;
/// Bits of a pass of the sort: a third of a key.
const DIGIT: u32 = BITS;
/// Orientations of the curve: 8 corners to enter a cube by, 3 axes to leave it along.
const STATES: usize = 24;

/// Two levels of the curve: `state << 6 | x << 4 | y << 2 | z` to `key << 5 | next state`.
static STEPS: LazyLock<[u16; 32 * 64]> = LazyLock::new(|| {
    // More than the 24 states, so that no lookup needs a check.
    let mut steps = [0; 32 * 64];
    for (index, step) in steps.iter_mut().take(STATES * 64).enumerate() {
        let [x, y, z] = [index >> 4 & 3, index >> 2 & 3, index & 3];
        let octant = |bit: usize| x >> bit & 1 | (y >> bit & 1) << 1 | (z >> bit & 1) << 2;
        let (high, state) = Orientation::from_index(index >> 6).step(octant(1));
        let (low, state) = state.step(octant(0));
        *step = ((high << 3 | low) << 5 | state.index()) as u16;
    }
    steps
});

/// How the curve runs through a cube.
#[derive(Clone, Copy)]
struct Orientation {
    /// Corner that it enters by, a bit per axis.
    entry: usize,
    /// Axis along which it leaves.
    axis: usize,
}

impl Orientation {
    fn from_index(index: usize) -> Self {
        Self { entry: index / 3, axis: index % 3 }
    }

    fn index(self) -> usize {
        self.entry * 3 + self.axis
    }

    /// When the curve visits an octant of the cube, and how it runs through that.
    fn step(self, octant: usize) -> (usize, Self) {
        let rotation = (self.axis + 1) % 3;
        let gray = rotate_right(octant ^ self.entry, rotation);
        let place = gray ^ gray >> 1 ^ gray >> 2;
        // Hamilton's theorem 2.10 and lemma 2.8.
        let before = place.saturating_sub(1) & !1;
        let entry = before ^ before >> 1;
        let along = match place {
            0 => 0,
            _ if place & 1 == 0 => (place - 1).trailing_ones() as usize % 3,
            _ => place.trailing_ones() as usize % 3,
        };
        (place, Self { entry: self.entry ^ rotate_left(entry, rotation), axis: (self.axis + along + 1) % 3 })
    }
}

fn rotate_left(bits: usize, by: usize) -> usize {
    (bits << by | bits >> (3 - by)) & 7
}

fn rotate_right(bits: usize, by: usize) -> usize {
    rotate_left(bits, (3 - by) % 3)
}

/// Indices of the points in the curve's order; points with equal keys keep theirs.
#[must_use]
pub fn order(points: impl ExactSizeIterator<Item = Vec3> + Clone) -> Vec<u32> {
    let (lower, upper) = points
        .clone()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lower, upper), p| (lower.min(p), upper.max(p)));
    let extent = (upper - lower).max_element().max(f32::MIN_POSITIVE);
    let scale = ((1 << BITS) - 1) as f32 / extent;
    let steps = &*STEPS;
    let mut counts = [[0_u32; 1 << DIGIT]; 3];
    let mut keyed: Vec<u64> = Vec::with_capacity(points.len());
    keyed.extend(points.enumerate().map(|(index, p)| {
        let key = key(steps, (p - lower) * scale);
        for (digit, counts) in counts.iter_mut().enumerate() {
            counts[digit_of(key.into(), digit)] += 1;
        }
        u64::from(key) << 32 | index as u64
    }));
    let mut sorted = vec![0; keyed.len()];
    for (digit, counts) in counts.iter_mut().enumerate() {
        let mut first = 0;
        for count in counts.iter_mut() {
            (first, *count) = (first + *count, first);
        }
        for &element in &keyed {
            let place = &mut counts[digit_of(element >> 32, digit)];
            sorted[*place as usize] = element;
            *place += 1;
        }
        std::mem::swap(&mut keyed, &mut sorted);
    }
    keyed.into_iter().map(|element| element as u32).collect()
}

fn digit_of(key: u64, digit: usize) -> usize {
    (key >> (digit as u32 * DIGIT)) as usize & ((1 << DIGIT) - 1)
}

/// Place along the curve of a point of [0, 2^BITS − 1]³, rounded.
fn key(steps: &[u16; 32 * 64], p: Vec3) -> u32 {
    // Added to 2²³ a float's last bits are the integer: a conversion with its checks costs three times as much.
    let [x, y, z] = p.to_array().map(|v| (v + 8_388_608.0).to_bits());
    let mut state = 0;
    let mut key = 0;
    for level in (0..BITS).step_by(2).rev() {
        let two = |axis: u32| (axis >> level & 3) as usize;
        let step = u32::from(steps[state << 6 | two(x) << 4 | two(y) << 2 | two(z)]);
        key = key << 6 | step >> 5;
        state = (step & 31) as usize;
    }
    key
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
            let place = &mut cells[(key(&STEPS, p * 64.0) >> 18) as usize];
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

    #[test]
    fn points_without_an_extent_keep_their_order() {
        assert!(order([].into_iter()).is_empty());
        assert_eq!(order([Vec3::splat(3.0); 4].into_iter()), [0, 1, 2, 3]);
        assert_eq!(order([Vec3::splat(1e30), Vec3::splat(-1e30)].into_iter()).len(), 2);
    }
}
