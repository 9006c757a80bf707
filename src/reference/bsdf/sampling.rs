//! The sampling mixture: a cosine lobe, an even one over the hemisphere, a GGX lobe by visible normals, one that
//! skims the surface, and a GTR1 lobe for the clear coat. Its shares are those of `glsl/lib/bsdf/sample.glsl`.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::{DVec2, DVec3};

use super::microfacet::Ggx;
use super::principled::gtr1;
use super::skimming::Skimming;

/// Least share of a lobe that exists, so that a wrong guess of its albedo costs noise and never a spike.
const LEAST_SHARE: f64 = 0.1;

/// Shares that sum to 1, and the lobes' shapes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture {
    cosine: f64,
    even: f64,
    specular: f64,
    coat: f64,
    skimming: f64,
    ggx: Ggx,
    coat_alpha: f64,
}

impl Mixture {
    /// The cosine lobe, and a share of the even one.
    pub(super) fn diffuse(even: f64) -> Self {
        let ggx = Ggx::isotropic(1.0);
        Self { cosine: 1.0, even: 0.0, specular: 0.0, coat: 0.0, skimming: 0.0, ggx, coat_alpha: 1.0 }
            .with_even(even)
    }

    /// Visible normals alone: of a microfacet lobe they leave F and the shadowing, which never exceed 1.
    pub(super) fn specular(ggx: Ggx) -> Self {
        Self::two(0.0, 1.0, ggx)
    }

    /// Both, in proportion to rough albedos. A `diffuse` of 0 says that there is nothing diffuse; a `specular` of 0 is
    /// only a guess.
    pub(super) fn two(diffuse: f64, specular: f64, ggx: Ggx) -> Self {
        let exists = diffuse > 0.0;
        let cosine =
            if exists { (diffuse / (diffuse + specular)).clamp(LEAST_SHARE, 1.0 - LEAST_SHARE) } else { 0.0 };
        Self { cosine, even: 0.0, specular: 1.0 - cosine, coat: 0.0, skimming: 0.0, ggx, coat_alpha: 1.0 }
    }

    /// Gives a share of the cosine lobe to an even one: over cosθi, what does not vanish at grazing angles has weights
    /// up to 1/cosθo.
    pub(super) fn with_even(self, share: f64) -> Self {
        Self { cosine: self.cosine * (1.0 - share), even: self.cosine * share, ..self }
    }

    /// Gives a share of the visible normals to a skimming lobe: of a coat without shadowing but with 1/(wi·h) they leave
    /// weights up to 1/cosθo.
    pub(super) fn with_skimming(self, share: f64) -> Self {
        Self { specular: self.specular * (1.0 - share), skimming: self.specular * share, ..self }
    }

    /// Adds the clear coat; `albedo` as in [`Mixture::two`], where the others are taken to sum to about 1.
    pub(super) fn with_coat(self, albedo: f64, coat_alpha: f64) -> Self {
        if albedo <= 0.0 {
            return self;
        }
        let coat = (albedo / (1.0 + albedo)).max(LEAST_SHARE);
        Self {
            cosine: self.cosine * (1.0 - coat),
            even: self.even * (1.0 - coat),
            specular: self.specular * (1.0 - coat),
            coat,
            coat_alpha,
            ..self
        }
    }

    /// One direction; the first number also chooses the lobe and is stretched back to [0, 1). Shares may round to a sum
    /// below it: the last lobe that exists takes what is left.
    pub(super) fn sample(&self, wo: DVec3, xi: DVec2) -> DVec3 {
        let mut x = xi.x;
        if x < self.cosine {
            return cosine(DVec2::new(x / self.cosine, xi.y));
        }
        x -= self.cosine;
        if x < self.even || self.specular == 0.0 {
            return even(DVec2::new((x / self.even).min(1.0), xi.y));
        }
        x -= self.even;
        if x < self.skimming {
            return Skimming::new(&self.ggx, wo).sample(DVec2::new(x / self.skimming, xi.y));
        }
        x -= self.skimming;
        let h = if x < self.specular || self.coat == 0.0 {
            self.ggx.sample_visible_normal(wo, DVec2::new((x / self.specular).min(1.0), xi.y))
        } else {
            let x = ((x - self.specular) / self.coat).min(1.0);
            gtr1_normal(self.coat_alpha, DVec2::new(x, xi.y))
        };
        2.0 * wo.dot(h) * h - wo
    }

    /// Density per solid angle.
    pub(super) fn pdf(&self, wo: DVec3, wi: DVec3) -> f64 {
        let mut pdf = (self.cosine * wi.z + 0.5 * self.even) * FRAC_1_PI;
        if self.specular > 0.0 {
            pdf += self.specular * self.ggx.pdf(wo, wi);
        }
        if self.skimming > 0.0 {
            pdf += self.skimming * Skimming::new(&self.ggx, wo).pdf(wi);
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

/// Every direction of the hemisphere alike.
fn even(xi: DVec2) -> DVec3 {
    let (cos, phi) = (1.0 - xi.x, 2.0 * PI * xi.y);
    let sin = (1.0 - cos * cos).sqrt();
    DVec3::new(sin * phi.cos(), sin * phi.sin(), cos)
}

/// A normal of density D(h) n·h: cos²θ = (1 − α^(2(1 − ξ)))/(1 − α²) (Burley 2012, appendix B).
pub(crate) fn gtr1_normal(alpha: f64, xi: DVec2) -> DVec3 {
    let a2 = alpha * alpha;
    let cos2 = ((1.0 - a2.powf(1.0 - xi.x)) / (1.0 - a2)).clamp(0.0, 1.0);
    let (sin, phi) = ((1.0 - cos2).sqrt(), 2.0 * PI * xi.y);
    DVec3::new(sin * phi.cos(), sin * phi.sin(), cos2.sqrt())
}
