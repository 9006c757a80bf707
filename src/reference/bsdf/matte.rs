//! Matte: Oren–Nayar's qualitative model, equation (12) corrected.

use std::f64::consts::FRAC_1_PI;

use glam::DVec3;

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
        let sigma2 = self.sigma.to_radians().powi(2);
        let a = 1.0 - sigma2 / (2.0 * (sigma2 + 0.33));
        let b = 0.45 * sigma2 / (sigma2 + 0.09);
        // sin θi sin θo cos(φi − φo); over max cos it is the classic sin α tan β.
        let s = wi.x * wo.x + wi.y * wo.y;
        let shape = if s > 0.0 { a + b * s / wi.z.max(wo.z) } else { a };
        self.color * FRAC_1_PI * shape
    }
}
