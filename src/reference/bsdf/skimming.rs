//! Directions that skim the surface away from the viewer, where 1/(wi·h) has its spike.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::microfacet::Ggx;

/// With wi at the angle θ from −wo and c = wi·h = sin(θ/2), c is even in [0, reach): the density has the spike 1/c. There
/// h = c wo + √(1 − c²)(cosψ up + sinψ across), ψ the azimuth about −wo, and tanψ is distributed as Cauchy's, of the scale
/// `alpha` around `slope` (cosθo − c), about where D(h) is greatest.
pub(super) struct Skimming {
    wo: DVec3,
    up: DVec3,
    across: DVec3,
    alpha: f64,
    slope: f64,
    reach: f64,
}

impl Skimming {
    pub(super) fn new(ggx: &Ggx, wo: DVec3) -> Self {
        let across = DVec3::new(-wo.y, wo.x, 0.0).normalize_or(DVec3::Y);
        let inverse = DVec3::new(ggx.alpha_x, ggx.alpha_y, f64::INFINITY).recip();
        let alpha = (across * inverse).length().recip();
        let slope = (wo * inverse).dot(across * inverse) * alpha * alpha;
        let reach = (wo.z + ggx.stretched_length(wo)).min(0.5);
        Self { wo, up: wo.cross(across), across, alpha, slope, reach }
    }

    pub(super) fn sample(&self, xi: DVec2) -> DVec3 {
        let c = self.reach * xi.x;
        let turn = DVec2::from_angle(PI * (xi.y - 0.5));
        let azimuth =
            (turn.x * self.up + (self.alpha * turn.y + self.center(c) * turn.x) * self.across).normalize();
        2.0 * c * (c * self.wo + (1.0 - c * c).max(0.0).sqrt() * azimuth) - self.wo
    }

    fn center(&self, c: f64) -> f64 {
        self.slope * (self.wo.z - c)
    }

    /// Density per solid angle, p(ψ)/(4 c reach).
    pub(super) fn pdf(&self, wi: DVec3) -> f64 {
        let c = 0.5 * (self.wo + wi).length();
        let (x, y) = (wi.dot(self.up), wi.dot(self.across));
        if x <= 0.0 || c >= self.reach {
            return 0.0;
        }
        let off = y - self.center(c) * x;
        let azimuth = self.alpha * (x * x + y * y) / (PI * (off * off + self.alpha * self.alpha * x * x));
        azimuth / (4.0 * c * self.reach)
    }
}
