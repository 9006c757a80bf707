//! The share of a BSDF that a virtual light stands for.

use glam::DVec3;

use crate::reference::bsdf::Bsdf;

/// Reflectance of the Lambertian lobe that stands for the BSDF's diffuse part, per channel: a virtual light on the
/// surface reflects this over π. Oren–Nayar's is its constant term; of substrate and principled, whose diffuse parts are
/// no Lambert lobes, it is their reflectance, and the gather follows the rest.
#[must_use]
pub fn lambert(bsdf: &Bsdf) -> DVec3 {
    match bsdf {
        Bsdf::Matte(matte) => {
            let sigma2 = matte.sigma.to_radians().powi(2);
            matte.color * (1.0 - sigma2 / (2.0 * (sigma2 + 0.33)))
        }
        Bsdf::Plastic(plastic) => plastic.diffuse,
        Bsdf::Metal(_) => DVec3::ZERO,
        Bsdf::Substrate(substrate) => substrate.diffuse * (DVec3::ONE - substrate.specular),
        Bsdf::Principled(principled) => principled.base_color * (1.0 - principled.metallic),
    }
}
