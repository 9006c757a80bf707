//! Substrate: Ashikhmin–Shirley's diffuse base under a glossy coat, equations (13), (14) corrected.

use std::f64::consts::PI;

use glam::DVec3;

use super::fresnel::schlick_weight;
use super::microfacet::Ggx;
use super::sampling::Mixture;

/// Ashikhmin–Shirley with the GGX distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Substrate {
    /// Diffuse reflectance Rd.
    pub diffuse: DVec3,
    /// Specular reflectance at normal incidence Rs.
    pub specular: DVec3,
    /// Roughness.
    pub ggx: Ggx,
}

/// 1 − (1 − c/2)⁵, expanded so that it does not cancel at grazing angles.
fn transmitted(cos: f64) -> f64 {
    let x = 0.5 * cos;
    x * (5.0 + x * (-10.0 + x * (10.0 + x * (-5.0 + x))))
}

/// The diffuse base without its reflectances.
pub(crate) fn base(wo: DVec3, wi: DVec3) -> f64 {
    28.0 / (23.0 * PI) * transmitted(wi.z) * transmitted(wo.z)
}

/// The glossy coat at reflectance 1.
pub(crate) fn coat(ggx: Ggx, wo: DVec3, wi: DVec3, h: DVec3, cos: f64) -> f64 {
    ggx.density(h) / (4.0 * cos * wi.z.max(wo.z))
}

impl Substrate {
    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> DVec3 {
        let (h, cos) = super::half_vector(wo, wi);
        let base = base(wo, wi);
        let fresnel = self.specular + (DVec3::ONE - self.specular) * schlick_weight(cos);
        let lobe = coat(self.ggx, wo, wi, h, cos);
        self.diffuse * (DVec3::ONE - self.specular) * base + fresnel * lobe
    }

    pub(super) fn mixture(&self, wo: DVec3) -> Mixture {
        let weight = schlick_weight(wo.z);
        let specular = self.specular.max_element() * (1.0 - weight) + weight;
        // 28/23 makes what the coat lets through the base's exact albedo.
        let base = (self.diffuse * (DVec3::ONE - self.specular)).max_element() * transmitted(wo.z);
        // Visible normals weigh (cosθo + L)/(2 cosθo) at most, L about alpha at grazing angles.
        let rest = self.ggx.stretched_length(wo) - wo.z;
        let skimming = 0.3 * (rest / (rest + 2.0 * wo.z)).max(0.0);
        Mixture::two(base, specular, self.ggx).with_skimming(skimming)
    }
}
