//! How far a table is from its lobes: the figures that are published with it.

use glam::{DMat3, DVec3};

use super::samples::Samples;
use super::{Basis, Frame, Lobe, density, leak};

/// Directions that judge a fit; not those that it was made with.
const SAMPLES: usize = 40_000;

/// What one transformed cosine makes of one lobe.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Assessment {
    /// Total variation between both at equal mass: half of ∫ |D − f cos / mass|.
    pub variation: f64,
    /// Largest error of `mass` × ∫ D over any set of directions against ∫ f cos, over `mass`.
    pub bound: f64,
    /// Share of D below the surface.
    pub leak: f64,
    /// Angle between both maxima, degrees.
    pub peak_shift: f64,
    /// Maximum of D over that of the lobe.
    pub peak_height: f64,
}

/// Compares `lobe` with the cosine transformed by `inverse` (local frame) and scaled by `mass`.
#[must_use]
pub fn assess(lobe: &Lobe, inverse: &DMat3, mass: f64) -> Assessment {
    assess_over(&Samples::new(lobe, &Basis::new(Frame::Normal, lobe), SAMPLES), lobe.albedo(), inverse, mass)
}

/// As [`assess`], over directions in the local frame and with the lobe's own mass known.
pub(super) fn assess_over(samples: &Samples, exact: f64, inverse: &DMat3, mass: f64) -> Assessment {
    let leak = leak(inverse);
    let ratio = mass / exact;
    // The samples' own sums are not exactly 1; both lobes are held to what they are known to be.
    let correction = exact / samples.mass();
    let (mut apart, mut over, mut under) = (leak, ratio * leak, 0.0);
    let (mut ours, mut theirs) = ((0.0, DVec3::Z), (0.0, DVec3::Z));
    for ((&w, weight), value) in samples.directions.iter().zip(&samples.weights).zip(&samples.lobe) {
        let (d, f) = (density(inverse, w), value * correction / exact);
        apart += weight * (d - f).abs();
        over += weight * (ratio * d - f).max(0.0);
        under += weight * (f - ratio * d).max(0.0);
        if d > ours.0 {
            ours = (d, w);
        }
        if f > theirs.0 {
            theirs = (f, w);
        }
    }
    // Maxima off the plane of incidence come in pairs.
    let aside = |w: DVec3| DVec3::new(w.x, w.y.abs(), w.z);
    Assessment {
        variation: 0.5 * apart,
        bound: over.max(under) / ratio,
        leak,
        peak_shift: aside(ours.1).angle_between(aside(theirs.1)).to_degrees(),
        peak_height: ours.0 / theirs.0,
    }
}
