//! Matte: Oren–Nayar's qualitative model, equation (12) corrected.

use std::f64::consts::FRAC_1_PI;

use glam::DVec3;

use super::sampling::Mixture;

/// Oren–Nayar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matte {
    /// Reflectance kd.
    pub color: DVec3,
    /// Standard deviation of the facets' slopes, degrees.
    pub sigma: f64,
}

impl Matte {
    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> DVec3 {
        let (a, b) = self.coefficients();
        // sin θi sin θo cos(φi − φo); over max cos it is the classic sin α tan β.
        let s = wi.x * wo.x + wi.y * wo.y;
        let shape = if s > 0.0 { a + b * s / wi.z.max(wo.z) } else { a };
        self.color * FRAC_1_PI * shape
    }

    /// A, of the Lambertian share, and B.
    fn coefficients(&self) -> (f64, f64) {
        let sigma2 = self.sigma.to_radians().powi(2);
        (1.0 - sigma2 / (2.0 * (sigma2 + 0.33)), 0.45 * sigma2 / (sigma2 + 0.09))
    }

    /// B's share of the light is even where the viewer grazes, B sinθo/2 of A, and nothing along the normal.
    pub(super) fn mixture(&self, wo: DVec3) -> Mixture {
        let (a, b) = self.coefficients();
        let even = 0.5 * b * wo.x.hypot(wo.y);
        Mixture::diffuse(even / (a + even))
    }
}
