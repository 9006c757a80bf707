//! The order of points along a Hilbert curve through their bounds, in linear time unless they crowd into few places.
//!
//! Keys have 10 bits an axis. They are Skilling's (2004, «Programming the Hilbert curve»), made two levels at a time by a
//! table of the states that his algorithm can be in. A stable radix sort of three passes orders them.

use glam::Vec3;
use std::sync::LazyLock;

/// Bits per axis.
const BITS: u32 = 10;
/// Bits of a pass of the sort: a third of a key.
const DIGIT: u32 = BITS;
/// Cells along an axis.
const CELLS: f32 = (1 << BITS) as f32;
/// Points of one cell that keep their order: those of a leaf of the tree with moments.
const LEAF: usize = 8;
/// From so many elements on a radix sort is faster.
const RADIX_LEAST: usize = 2048;
/// Orders and signs of the axes, and the sign of the Gray code.
const STATES: usize = 6 * 8 * 2;

/// Two levels of the curve: `state << 6 | x << 4 | y << 2 | z` to `key << 7 | next state`.
static STEPS: LazyLock<[u16; 128 * 64]> = LazyLock::new(|| {
    // More than the states, so that no lookup needs a check.
    let mut steps = [0; 128 * 64];
    for (index, step) in steps.iter_mut().take(STATES * 64).enumerate() {
        let [x, y, z] = [index >> 4 & 3, index >> 2 & 3, index & 3];
        let octant = |bit: usize| [x >> bit & 1, y >> bit & 1, z >> bit & 1];
        let (high, state) = State::from_index(index >> 6).step(octant(1));
        let (low, state) = state.step(octant(0));
        *step = ((high << 3 | low) << 7 | state.index()) as u16;
    }
    steps
});

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

/// Orders of the axes.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

impl State {
    fn from_index(index: usize) -> Self {
        let bit = |i: usize| index >> i & 1;
        Self { axes: ORDERS[index >> 4], inverted: [bit(0), bit(1), bit(2)], gray: bit(3) }
    }

    fn index(self) -> usize {
        let order = ORDERS.iter().position(|order| *order == self.axes).unwrap_or(0);
        order << 4 | self.gray << 3 | self.inverted[2] << 2 | self.inverted[1] << 1 | self.inverted[0]
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

/// A part of space, and the curve's state on entering it.
#[derive(Clone, Copy)]
struct Cube {
    lower: Vec3,
    size: f32,
    state: usize,
}

/// Indices of `count` points in the curve's order; points in one place keep theirs.
///
/// Points that share a cell follow the curve on inside it: one point far from all others, which makes the cells large, does
/// not leave the others in disorder.
#[must_use]
pub fn order(count: usize, point: impl Fn(usize) -> Vec3) -> Vec<u32> {
    let (lower, upper) = bulk(count, &point);
    let inside = |index: u64| {
        let place = point(index as usize);
        place.cmpge(lower).all() && place.cmple(upper).all()
    };
    let mut elements: Vec<u64> = (0..count as u64).filter(|index| inside(*index)).collect();
    let many = elements.len();
    elements.extend((0..count as u64).filter(|index| many < count && !inside(*index)));
    let mut sorted = vec![0; count];
    let everywhere = Cube { lower: Vec3::ZERO, size: f32::INFINITY, state: 0 };
    let (bulk, far) = elements.split_at_mut(many);
    sort(bulk, &mut sorted[..many], &point, everywhere);
    sort(far, &mut sorted[many..], &point, everywhere);
    elements.into_iter().map(|element| element as u32).collect()
}

/// A box around all but a few far points, which get a curve of their own: by the 5th and the 95th percentile of a sample.
fn bulk(count: usize, point: &impl Fn(usize) -> Vec3) -> (Vec3, Vec3) {
    let sample: Vec<Vec3> = (0..count).step_by((count / 1024).max(1)).map(point).collect();
    if sample.len() < 64 {
        return (Vec3::NEG_INFINITY, Vec3::INFINITY);
    }
    let percentile = |percent: usize| {
        Vec3::from_array(std::array::from_fn(|axis| {
            let mut values: Vec<f32> = sample.iter().map(|place| place[axis]).collect();
            let rank = values.len() * percent / 100;
            *values.select_nth_unstable_by(rank, f32::total_cmp).1
        }))
    };
    let (low, high) = (percentile(5), percentile(95));
    let margin = 2.0 * (high - low).max_element();
    (low - margin, high + margin)
}

/// Sorts elements, whose lower halves are indices of points in a cube; those in one of its cells are sorted again, where
/// there are more than a leaf of the trees holds. Points that fill little of the cube get a curve of their own.
fn sort(elements: &mut [u64], sorted: &mut [u64], point: &impl Fn(usize) -> Vec3, mut cube: Cube) {
    let places = elements.iter().map(|element| point(*element as u32 as usize));
    let (lower, upper) =
        places.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lower, upper), p| (lower.min(p), upper.max(p)));
    let extent = (upper - lower).max_element().clamp(0.0, f32::MAX);
    if extent < f32::MIN_POSITIVE {
        return;
    }
    if extent < cube.size / 8.0 {
        // The last cell is the upper corner's.
        cube = Cube { lower, size: (extent * (CELLS / (CELLS - 1.0))).min(f32::MAX), state: 0 };
    }
    let scale = (CELLS / cube.size).min(f32::MAX);
    let cell = |index: u32| ((point(index as usize) - cube.lower) * scale).min(Vec3::splat(CELLS - 1.0));
    let steps = &*STEPS;
    for element in elements.iter_mut() {
        let index = *element as u32;
        *element = u64::from(key(steps, cell(index), cube.state).0) << 32 | u64::from(index);
    }
    if elements.len() < RADIX_LEAST {
        elements.sort_unstable()
    } else {
        radix_sort(elements, sorted)
    }
    let all = elements.len();
    let mut rest = elements;
    while let Some(&first) = rest.first() {
        let count = rest.iter().take_while(|element| **element >> 32 == first >> 32).count();
        let (run, behind) = rest.split_at_mut(count);
        if count > LEAF && (count < all || cube.size > extent) {
            let place = cell(first as u32);
            let size = cube.size / CELLS;
            let lower = cube.lower + place.floor().max(Vec3::ZERO) * size;
            let inside = Cube { lower, size, state: key(steps, place, cube.state).1 };
            sort(run, &mut sorted[..count], point, inside);
        }
        rest = behind;
    }
}

/// By the upper halves; equal ones keep their order.
fn radix_sort(elements: &mut [u64], sorted: &mut [u64]) {
    let mut counts = [[0_u32; 1 << DIGIT]; 3];
    for element in &*elements {
        for (digit, counts) in counts.iter_mut().enumerate() {
            counts[digit_of(element >> 32, digit)] += 1;
        }
    }
    let (mut from, mut to) = (elements, sorted);
    for (digit, counts) in counts.iter_mut().enumerate() {
        let mut first = 0;
        for count in counts.iter_mut() {
            (first, *count) = (first + *count, first);
        }
        for &element in &*from {
            let place = &mut counts[digit_of(element >> 32, digit)];
            to[*place as usize] = element;
            *place += 1;
        }
        std::mem::swap(&mut from, &mut to);
    }
    // Three passes leave it in the other half.
    to.copy_from_slice(from);
}

fn digit_of(key: u64, digit: usize) -> usize {
    (key >> (digit as u32 * DIGIT)) as usize & ((1 << DIGIT) - 1)
}

/// Place along the curve of a point of [0, 2^BITS − 1]³, and the state in its cell.
fn key(steps: &[u16; 128 * 64], p: Vec3, mut state: usize) -> (u32, usize) {
    // Added to 2²³ a float's last bits are the integer: a conversion with its checks costs three times as much.
    let [x, y, z] = p.to_array().map(|v| ((v - 0.5).max(0.0) + 8_388_608.0).to_bits());
    let mut key = 0;
    for level in (0..BITS).step_by(2).rev() {
        let two = |axis: u32| (axis >> level & 3) as usize;
        let step = u32::from(steps[state << 6 | two(x) << 4 | two(y) << 2 | two(z)]);
        key = key << 6 | step >> 7;
        state = (step & 127) as usize;
    }
    (key, state)
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
            let place = &mut cells[(key(&STEPS, p * 64.0 + 0.5, 0).0 >> 18) as usize];
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
        let order = order(points.len(), |i| points[i]);
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
        assert!(order(0, |_| Vec3::ZERO).is_empty());
        assert_eq!(order(40, |_| Vec3::splat(3.0)), (0..40).collect::<Vec<_>>());
        for size in [f32::MIN_POSITIVE, 1e-45, 1e30, f32::MAX] {
            let mut order = order(40, |i| Vec3::splat(if i % 2 == 0 { size } else { -size }));
            order.sort_unstable();
            assert_eq!(order, (0..40).collect::<Vec<_>>());
        }
    }
}
