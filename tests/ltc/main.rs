//! The tables of linearly transformed cosines, against the oracle's BSDFs, closed forms, fits made anew and quadratures
//! of the tests' own.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod fits;
mod integrals;
mod lobes;
mod rectangles;

use amas::ltc::{Layer, Parameters, Tables};
use glam::DVec3;

fn tables() -> &'static Tables {
    amas::ltc::tables().unwrap()
}

/// Evenly spread numbers in [0, 1), the same on every run: SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A unit vector above the surface.
    fn above(&mut self) -> DVec3 {
        let (z, phi) = (self.between(0.01, 1.0), self.between(0.0, std::f64::consts::TAU));
        let sin = (1.0 - z * z).sqrt();
        DVec3::new(sin * phi.cos(), sin * phi.sin(), z)
    }

    /// Within the axis of `layer`, and an angle of up to `degrees`.
    fn parameters(&mut self, layer: Layer, degrees: f64) -> Parameters {
        let [first, last] = layer.axis();
        at(self.between(first, last), self.between(0.0, degrees))
    }
}

/// Roughness and angle in degrees.
fn at(r: f64, degrees: f64) -> Parameters {
    Parameters { r, cos: degrees.to_radians().cos() }
}
