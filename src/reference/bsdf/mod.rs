//! The five BSDFs in double precision, in the local frame: z the normal, x the tangent, y = z × x.
//!
//! Values are f(wo, wi) in sr⁻¹, RGB, **without** the cosine, and zero unless both directions are above the surface.
//! Sampling, for the area lights' estimator ([`crate::reference::area`]) and for paths, is by a mixture of wide lobes and
//! the microfacet ones, whose density need not match f, only cover it.

pub(crate) mod fresnel;
mod matte;
mod metal;
mod microfacet;
mod plastic;
pub(crate) mod principled;
pub(crate) mod sampling;
mod skimming;
pub(crate) mod substrate;

pub use fresnel::{conductor as fresnel_conductor, dielectric as fresnel_dielectric};
pub use matte::Matte;
pub use metal::Metal;
pub use microfacet::Ggx;
pub use plastic::Plastic;
pub use principled::Principled;
pub use substrate::Substrate;

use glam::{DVec2, DVec3};
use sampling::Mixture;

/// A BSDF with its parameters resolved at one point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bsdf {
    /// Oren–Nayar.
    Matte(Matte),
    /// Lambert and a dielectric GGX lobe.
    Plastic(Plastic),
    /// GGX with conductor Fresnel.
    Metal(Metal),
    /// Ashikhmin–Shirley.
    Substrate(Substrate),
    /// Disney 2012.
    Principled(Principled),
}

impl Bsdf {
    /// f(wo, wi), sr⁻¹, without the cosine; both directions unit.
    #[must_use]
    pub fn eval(&self, wo: DVec3, wi: DVec3) -> DVec3 {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return DVec3::ZERO;
        }
        match self {
            Self::Matte(bsdf) => bsdf.eval(wo, wi),
            Self::Plastic(bsdf) => bsdf.eval(wo, wi),
            Self::Metal(bsdf) => bsdf.eval(wo, wi),
            Self::Substrate(bsdf) => bsdf.eval(wo, wi),
            Self::Principled(bsdf) => bsdf.eval(wo, wi),
        }
    }

    /// A direction towards the light for `xi` in [0, 1)²; possibly below the surface, where f is zero.
    #[must_use]
    pub fn sample(&self, wo: DVec3, xi: DVec2) -> DVec3 {
        self.mixture(wo).sample(wo, xi)
    }

    /// Density of [`Bsdf::sample`] at `wi`, sr⁻¹.
    #[must_use]
    pub fn pdf(&self, wo: DVec3, wi: DVec3) -> f64 {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return 0.0;
        }
        self.mixture(wo).pdf(wo, wi)
    }

    fn mixture(&self, wo: DVec3) -> Mixture {
        match self {
            Self::Matte(bsdf) => bsdf.mixture(wo),
            Self::Plastic(bsdf) => bsdf.mixture(wo),
            Self::Metal(bsdf) => Mixture::specular(bsdf.ggx),
            Self::Substrate(bsdf) => bsdf.mixture(wo),
            Self::Principled(bsdf) => bsdf.mixture(wo),
        }
    }
}

/// The half vector's cosine with either direction, wi·h = |wi + wo|/2, and h itself.
pub(crate) fn half_vector(wo: DVec3, wi: DVec3) -> (DVec3, f64) {
    let sum = wo + wi;
    let length = sum.length();
    (sum / length, (0.5 * length).min(1.0))
}

/// x⁵.
fn pow5(x: f64) -> f64 {
    let x2 = x * x;
    x2 * x2 * x
}
