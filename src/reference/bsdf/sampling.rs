//! The sampling mixture: a cosine lobe, a GGX lobe by visible normals, and a GTR1 lobe for the clear coat.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::{DVec2, DVec3};

use super::microfacet::Ggx;
use super::principled::gtr1;

/// Least share of a lobe that exists, so that a wrong guess of its albedo costs noise and never a spike.
const LEAST_SHARE: f64 = 0.1;

/// Shares that sum to 1, and the lobes' shapes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture {
    cosine: f64,
    specular: f64,
    coat: f64,
    ggx: Ggx,
    coat_alpha: f64,
}

impl Mixture {
    /// The cosine lobe alone.
    pub(super) fn diffuse() -> Self {
        Self { cosine: 1.0, specular: 0.0, coat: 0.0, ggx: Ggx::isotropic(1.0), coat_alpha: 1.0 }
    }

    /// Visible normals alone, with a little of the cosine lobe for the tails.
    pub(super) fn specular(ggx: Ggx) -> Self {
        Self::two(0.0, 1.0, ggx)
    }

    /// Both, in proportion to rough albedos.
    pub(super) fn two(diffuse: f64, specular: f64, ggx: Ggx) -> Self {
        let sum = diffuse + specular;
        let share = if sum > 0.0 { specular / sum } else { 0.5 };
        let specular = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
        Self { cosine: 1.0 - specular, specular, coat: 0.0, ggx, coat_alpha: 1.0 }
    }

    /// Adds the clear coat; `albedo` as in [`Mixture::two`], where the others are taken to sum to about 1.
    pub(super) fn with_coat(self, albedo: f64, coat_alpha: f64) -> Self {
        if albedo <= 0.0 {
            return self;
        }
        let coat = (albedo / (1.0 + albedo)).max(LEAST_SHARE);
        Self {
            cosine: self.cosine * (1.0 - coat),
            specular: self.specular * (1.0 - coat),
            coat,
            coat_alpha,
            ..self
        }
    }

    /// One direction; the first number also chooses the lobe and is stretched back to [0, 1).
    pub(super) fn sample(&self, wo: DVec3, xi: DVec2) -> DVec3 {
        if xi.x < self.cosine {
            return cosine(DVec2::new(xi.x / self.cosine, xi.y));
        }
        let rest = xi.x - self.cosine;
        let h = if rest < self.specular {
            self.ggx.sample_visible_normal(wo, DVec2::new(rest / self.specular, xi.y))
        } else {
            let x = ((rest - self.specular) / self.coat).clamp(0.0, 1.0);
            gtr1_normal(self.coat_alpha, DVec2::new(x, xi.y))
        };
        2.0 * wo.dot(h) * h - wo
    }

    /// Density per solid angle.
    pub(super) fn pdf(&self, wo: DVec3, wi: DVec3) -> f64 {
        let mut pdf = self.cosine * wi.z * FRAC_1_PI;
        if self.specular > 0.0 {
            pdf += self.specular * self.ggx.pdf(wo, wi);
        }
        if self.coat > 0.0 {
            let (h, cos) = super::half_vector(wo, wi);
            pdf += self.coat * gtr1(h, self.coat_alpha) * h.z / (4.0 * cos);
        }
        pdf
    }
}

/// Cosine-weighted hemisphere by Shirley and Chiu's concentric map, which keeps neighbours together.
pub(crate) fn cosine(xi: DVec2) -> DVec3 {
    let p = crate::reference::sampler::concentric_disk(xi);
    DVec3::new(p.x, p.y, (1.0 - p.length_squared()).max(0.0).sqrt())
}

/// A normal of density D(h) n·h: cos²θ = (1 − α^(2(1 − ξ)))/(1 − α²) (Burley 2012, appendix B).
pub(crate) fn gtr1_normal(alpha: f64, xi: DVec2) -> DVec3 {
    let a2 = alpha * alpha;
    let cos2 = ((1.0 - a2.powf(1.0 - xi.x)) / (1.0 - a2)).clamp(0.0, 1.0);
    let (sin, phi) = ((1.0 - cos2).sqrt(), 2.0 * PI * xi.y);
    DVec3::new(sin * phi.cos(), sin * phi.sin(), cos2.sqrt())
}
