//! A lobe's albedo and Fresnel moments, by quadrature that knows where the horizon is.
//!
//! Lobes about the mirror direction are integrated over half vectors h: at a given azimuth, wi = 2(wo·h)h − wo is above
//! the surface exactly for polar angles below (π/2 + atan2(sin θo cos φ, cos θo))/2, so nothing is cut inside an
//! interval; tan θh = alpha tan ψ makes the distribution flat in ψ.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::lobe::mix;
use super::quadrature::integrate;
use super::{Frame, Lobe};

/// Absolute error asked of each integral.
const TOLERANCE: f64 = 1e-7;
const DEPTH: u32 = 14;

impl Lobe {
    /// ∫ f n·wi F dwi for the three factors F whose integrals a table stores: (A0, A5, A82), or for plastic the
    /// albedos at three indices of refraction.
    #[must_use]
    pub fn moments(&self) -> [f64; 3] {
        let halves = [[0.0, FRAC_PI_2], [FRAC_PI_2, PI]];
        let sums = halves.map(|half| {
            let mut slice = |phi: f64| match self.layer.frame() {
                Frame::Mirror => self.half_vectors(phi),
                Frame::Normal => self.directions(phi),
            };
            integrate(&mut slice, half, TOLERANCE, DEPTH)
        });
        std::array::from_fn(|n| 2.0 * (sums[0][n] + sums[1][n]))
    }

    /// ∫ f n·wi dwi: the first of [`Lobe::moments`], or the mixture of them that makes the lobe.
    #[must_use]
    pub fn albedo(&self) -> f64 {
        mix(self.layer, self.moments())
    }

    /// Over half vectors of azimuth `phi`.
    fn half_vectors(&self, phi: f64) -> [f64; 3] {
        let (sin_phi, cos_phi) = phi.sin_cos();
        let horizon = 0.5 * (FRAC_PI_2 + (self.wo.x * cos_phi).atan2(self.wo.z));
        let end = (horizon.tan() / self.alpha).atan();
        let mut integrand = |psi: f64| {
            let tan = self.alpha * psi.tan();
            let cos = 1.0 / tan.hypot(1.0);
            let sin = tan * cos;
            let h = DVec3::new(sin * cos_phi, sin * sin_phi, cos);
            let cos_d = self.wo.dot(h);
            // dθ = alpha sec²ψ cos²θ dψ, dwi = 4 (wo·h) dh.
            let measure = 4.0 * cos_d * sin * (self.alpha + tan * tan / self.alpha) * cos * cos;
            self.weighted(2.0 * cos_d * h - self.wo).map(|value| value * measure)
        };
        integrate(&mut integrand, [0.0, end], TOLERANCE, DEPTH)
    }

    /// Over directions of azimuth `phi`, in their cosine; split where wi is as high as wo.
    fn directions(&self, phi: f64) -> [f64; 3] {
        let (sin_phi, cos_phi) = phi.sin_cos();
        let mut integrand = |cos: f64| {
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            self.weighted(DVec3::new(sin * cos_phi, sin * sin_phi, cos))
        };
        let below = integrate(&mut integrand, [0.0, self.wo.z], TOLERANCE, DEPTH);
        let above = integrate(&mut integrand, [self.wo.z, 1.0], TOLERANCE, DEPTH);
        std::array::from_fn(|n| below[n] + above[n])
    }
}
