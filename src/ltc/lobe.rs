//! The lobes that are fitted, from the oracle's own BSDFs: f(wo, wi) n·wi in the local frame, z the normal, wo in the
//! plane of x and z.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::{Layer, Parameters};
use crate::reference::bsdf::fresnel::schlick_weight;
use crate::reference::bsdf::{Bsdf, Ggx, Matte, fresnel_dielectric, half_vector, principled, substrate};

/// Below this the lobe is no different but for its scale, and rounding begins to show.
const LEAST_ALPHA: f64 = 1e-4;
/// Likewise the least n·wo: the last row of a table is a limit.
const LEAST_COS: f64 = 1e-4;

/// Indices of refraction whose albedo the plastic layer stores; any other one's is a weighted sum of these.
pub const PLASTIC_ETAS: [f64; 3] = [1.5, 1.2, 2.2];

/// The lobe's own among the three integrals, or factors, of `layer`.
pub(super) fn mix(layer: Layer, values: [f64; 3]) -> f64 {
    layer.mixture().into_iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// One lobe of a layer: its parameters resolved.
#[derive(Clone, Copy, Debug)]
pub struct Lobe {
    pub(super) layer: Layer,
    /// Towards the viewer.
    pub wo: DVec3,
    pub(super) r: f64,
    pub(super) alpha: f64,
}

impl Lobe {
    /// The lobe of `layer` at `parameters`, kept off the limits where it would degenerate.
    #[must_use]
    pub fn new(layer: Layer, parameters: Parameters) -> Self {
        let Parameters { r, cos } = parameters;
        let cos = cos.clamp(LEAST_COS, 1.0);
        let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        Self { layer, wo, r, alpha: (r * r).max(LEAST_ALPHA) }
    }

    /// f(wo, wi) n·wi, sr⁻¹; zero below the surface.
    #[must_use]
    pub fn eval(&self, wi: DVec3) -> f64 {
        let (h, cos_d) = half_vector(self.wo, wi);
        self.geometry(wi, h, cos_d) * mix(self.layer, self.weights(cos_d))
    }

    /// The lobe times each of the three factors whose integrals a table stores.
    pub(super) fn weighted(&self, wi: DVec3) -> [f64; 3] {
        let (h, cos_d) = half_vector(self.wo, wi);
        let geometry = self.geometry(wi, h, cos_d);
        self.weights(cos_d).map(|weight| geometry * weight)
    }

    /// Fresnel's factors: 1, Schlick's weight and Lazányi's, or three dielectrics.
    fn weights(&self, cos_d: f64) -> [f64; 3] {
        if self.layer == Layer::Plastic {
            return PLASTIC_ETAS.map(|eta| fresnel_dielectric(cos_d, eta));
        }
        let rest = 1.0 - cos_d;
        [1.0, schlick_weight(cos_d), cos_d * rest.powi(6)]
    }

    /// The lobe without the factors of [`Lobe::weights`].
    fn geometry(&self, wi: DVec3, h: DVec3, cos_d: f64) -> f64 {
        let wo = self.wo;
        if wi.z <= 0.0 {
            return 0.0;
        }
        let ggx = Ggx::isotropic(self.alpha);
        let f = match self.layer {
            Layer::Metal | Layer::Plastic => ggx.density(h) * ggx.visibility_correlated(wo, wi),
            Layer::PrincipledSpecular | Layer::PrincipledDielectric => {
                ggx.density(h) * ggx.visibility_separable(wo, wi)
            }
            Layer::SubstrateSpecular | Layer::SubstrateDielectric => substrate::coat(ggx, wo, wi, h, cos_d),
            Layer::Clearcoat => principled::clearcoat(wo, wi, h, cos_d, self.alpha),
            Layer::Matte => {
                let sigma = (FRAC_PI_2 * self.r).to_degrees();
                Bsdf::Matte(Matte { color: DVec3::ONE, sigma }).eval(wo, wi).x
            }
            Layer::PrincipledDiffuse => principled::diffuse_and_retro(self.r, wo, wi, cos_d),
            Layer::Subsurface => principled::subsurface(self.r, wo, wi, cos_d),
            Layer::Sheen => schlick_weight(cos_d),
            Layer::SubstrateDiffuse => substrate::base(wo, wi),
        };
        f * wi.z
    }
}
