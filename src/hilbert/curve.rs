//! The curve itself: the cells of a grid, and the place of each along it.

use crate::shared::{HILBERT_BITS as BITS, HILBERT_KEY_BITS as KEY_BITS};
use glam::Vec3;
use std::sync::LazyLock;

/// As many keys are made together: their bits four at a time, where processors can, and only then one by one.
const BLOCK: usize = 64;
/// Orientations of the curve.
const STATES: usize = 24;
/// Bits of a state's number.
const STATE_BITS: u32 = 5;
/// Three levels of the curve: `state << 9 | x << 6 | y << 3 | z` to `next state << 9 | key`. Its length lets no
/// lookup need a check.
type Steps = [u16; 512 << STATE_BITS];

pub(super) static STEPS: LazyLock<Box<Steps>> = LazyLock::new(|| {
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
            steps[number << 9 | cell] = (next << 9 | key) as u16;
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

/// The cells of the curve.
pub(crate) struct Grid {
    /// Corner of the first cell.
    pub(crate) lower: Vec3,
    /// Cells a metre.
    pub(crate) scale: f32,
}

impl Grid {
    pub(super) fn over([lower, upper]: [Vec3; 2]) -> Self {
        // Halves, so that no difference of numbers is infinite.
        let extent = (0.5 * upper - 0.5 * lower).max_element();
        // The far corner still falls into a cell.
        Self { lower, scale: (0.5 * ((1 << BITS) - 4) as f32 / extent).min(f32::MAX) }
    }

    /// Keys of the points.
    pub(super) fn keys(&self, mut points: impl ExactSizeIterator<Item = Vec3>) -> Vec<u32> {
        let steps = &**STEPS;
        let mut keys = Vec::with_capacity(points.len());
        let mut block = [Vec3::ZERO; BLOCK];
        loop {
            let mut count = 0;
            for (slot, point) in block.iter_mut().zip(&mut points) {
                *slot = point;
                count += 1;
            }
            keys.extend_from_slice(&self.block_keys(steps, &block)[..count]);
            if count < BLOCK {
                return keys;
            }
        }
    }

    /// The first bits of each point's place along the curve.
    fn block_keys(&self, steps: &Steps, points: &[Vec3; BLOCK]) -> [u32; BLOCK] {
        let mut halves = [[0; 2]; BLOCK];
        for (halves, point) in halves.iter_mut().zip(points) {
            // Added to 2²³ a float's last bits are the integer: a conversion with its checks costs three times as much.
            let place = ((point - self.lower) * self.scale - 0.5).max(Vec3::ZERO) + 8_388_608.0;
            let [x, y, z] = place.to_array().map(f32::to_bits);
            *halves = [6, 0].map(|bit| threes(x >> bit) << 6 | threes(y >> bit) << 3 | threes(z >> bit));
        }
        halves.map(|[high, low]| {
            let mut state = 0;
            let mut key = 0_u64;
            for cell in [high >> 9, high, low >> 9, low] {
                let step = usize::from(steps[state | cell as usize & 511]);
                key = key << 9 | (step & 511) as u64;
                state = step & ((1 << STATE_BITS) - 1) << 9;
            }
            (key >> (3 * BITS - KEY_BITS)) as u32
        })
    }
}

/// The last six bits, three at a time, nine bits apart.
fn threes(v: u32) -> u32 {
    let v = v & 0o77;
    (v | v << 6) & 0o7007
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_space() {
        // 16³ cells, four levels: every cell once, each beside the last.
        let point = |i: usize| Vec3::new((i & 15) as f32, (i >> 4 & 15) as f32, (i >> 8) as f32);
        let grid = Grid { lower: Vec3::ZERO, scale: 256.0 };
        let mut cells = vec![None; 4096];
        for first in (0..4096).step_by(BLOCK) {
            let points: [Vec3; BLOCK] = std::array::from_fn(|i| point(first + i));
            let keys = grid.block_keys(&STEPS, &points.map(|p| p + 1.0 / 512.0));
            for (p, key) in points.into_iter().zip(keys) {
                assert!(cells[(key >> 20) as usize].replace(p).is_none());
            }
        }
        for pair in cells.windows(2) {
            let [a, b] = [pair[0].unwrap(), pair[1].unwrap()];
            assert_eq!((a - b).abs().element_sum(), 1.0, "{a} {b}");
        }
    }
}
