//! Metal: an anisotropic GGX lobe with conductor Fresnel, equation (2).

use glam::DVec3;

use super::fresnel::conductor;
use super::microfacet::Ggx;

/// D · V · F, height-correlated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// Real part of the index of refraction per channel.
    pub eta: DVec3,
    /// Absorption per channel.
    pub k: DVec3,
    /// Roughness.
    pub ggx: Ggx,
}

impl Metal {
    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> DVec3 {
        let (h, cos) = super::half_vector(wo, wi);
        let fresnel = DVec3::new(
            conductor(cos, self.eta.x, self.k.x),
            conductor(cos, self.eta.y, self.k.y),
            conductor(cos, self.eta.z, self.k.z),
        );
        fresnel * (self.ggx.density(h) * self.ggx.visibility_correlated(wo, wi))
    }
}
