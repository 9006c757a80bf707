//! Plastic: Lambert plus a dielectric GGX lobe, equations (7), (2).

use std::f64::consts::FRAC_1_PI;

use glam::DVec3;

use super::fresnel::dielectric;
use super::microfacet::Ggx;
use super::sampling::Mixture;

/// kd/π + ks · D · V · F(air → eta), height-correlated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Diffuse reflectance kd.
    pub diffuse: DVec3,
    /// Scale of the specular lobe ks.
    pub specular: DVec3,
    /// Index of refraction relative to air.
    pub eta: f64,
    /// Isotropic roughness.
    pub alpha: f64,
}

impl Plastic {
    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> DVec3 {
        let ggx = Ggx::isotropic(self.alpha);
        let (h, cos) = super::half_vector(wo, wi);
        let lobe = ggx.density(h) * ggx.visibility_correlated(wo, wi) * dielectric(cos, self.eta);
        self.diffuse * FRAC_1_PI + self.specular * lobe
    }

    pub(super) fn mixture(&self, wo: DVec3) -> Mixture {
        let specular = self.specular.max_element() * dielectric(wo.z.min(1.0), self.eta);
        Mixture::two(self.diffuse.max_element(), specular, Ggx::isotropic(self.alpha))
    }
}
