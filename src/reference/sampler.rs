//! Quasi-random points: Roberts' R2 sequence, shifted at random so that every estimate is unbiased and independent
//! shifts tell its standard error.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec2;

/// Mixes numbers to a seed; the finaliser of SplitMix64 after each.
pub(crate) fn hash(numbers: &[u64]) -> u64 {
    numbers.iter().fold(0x9e37_79b9_7f4a_7c15, |state, number| {
        let mut z = (state ^ number).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}

/// A uniform number in [0, 1) of 53 bits.
fn uniform(bits: u64) -> f64 {
    (bits >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// Independent uniform numbers: the hashes of a seed and a counter.
#[derive(Clone, Debug)]
pub(crate) struct Random {
    seed: u64,
    count: u64,
}

impl Random {
    /// The numbers of a seed; different seeds are independent.
    pub(crate) fn new(seed: u64) -> Self {
        Self { seed, count: 0 }
    }

    /// The next number in [0, 1).
    pub(crate) fn next(&mut self) -> f64 {
        self.count += 1;
        uniform(hash(&[self.seed, self.count]))
    }

    /// The next two.
    pub(crate) fn pair(&mut self) -> DVec2 {
        DVec2::new(self.next(), self.next())
    }
}

/// A shifted R2 sequence in [0, 1)².
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sequence {
    shift: DVec2,
}

impl Sequence {
    /// The sequence of a seed; different seeds are independent.
    pub(crate) fn new(seed: u64) -> Self {
        Self { shift: DVec2::new(uniform(hash(&[seed, 0])), uniform(hash(&[seed, 1]))) }
    }

    /// Point `index`; any prefix is well spread.
    pub(crate) fn point(&self, index: u32) -> DVec2 {
        // 1/g and 1/g², g the real root of x³ = x + 1: the most irrational pair.
        const STEP: DVec2 = DVec2::new(0.754_877_666_246_692_7, 0.569_840_290_998_053_2);
        (self.shift + f64::from(index) * STEP).fract()
    }
}

/// Shirley and Chiu's area-preserving map of the unit square to the unit disk.
pub(crate) fn concentric_disk(xi: DVec2) -> DVec2 {
    let p = 2.0 * xi - DVec2::ONE;
    if p == DVec2::ZERO {
        return DVec2::ZERO;
    }
    let (r, phi) = if p.x.abs() > p.y.abs() {
        (p.x, FRAC_PI_4 * (p.y / p.x))
    } else {
        (p.y, FRAC_PI_2 - FRAC_PI_4 * (p.x / p.y))
    };
    r * DVec2::from_angle(phi)
}
