//! Principled: Burley 2012, *Physically Based Shading at Disney*, equations (15)–(23) with the retro-reflection.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::DVec3;

use super::fresnel::schlick_weight;
use super::microfacet::Ggx;
use super::sampling::Mixture;

/// Disney 2012.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled {
    /// Base colour c.
    pub base_color: DVec3,
    /// Metalness.
    pub metallic: f64,
    /// Index of refraction of the dielectric part.
    pub eta: f64,
    /// Perceptual roughness, for the diffuse lobes.
    pub roughness: f64,
    /// Roughness of the specular lobe.
    pub ggx: Ggx,
    /// Tints the dielectric specular towards the base colour.
    pub specular_tint: f64,
    /// Weight of the sheen.
    pub sheen: f64,
    /// Tints the sheen towards the base colour.
    pub sheen_tint: f64,
    /// Weight of the clear coat.
    pub clearcoat: f64,
    /// 0 satin, 1 gloss.
    pub clearcoat_gloss: f64,
    /// Blends the diffuse lobe to Hanrahan and Krueger's shape.
    pub subsurface: f64,
}

/// Rec.709 luminance as pbrt weighs it.
const LUMINANCE: DVec3 = DVec3::new(0.212_671, 0.715_160, 0.072_169);
/// Alpha of the clear coat's masking, fixed by the model.
const CLEARCOAT_MASKING_ALPHA: f64 = 0.25;

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

impl Principled {
    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> DVec3 {
        let (h, cos) = super::half_vector(wo, wi);
        let dielectric = (1.0 - self.metallic) * (self.base(wo, wi, cos) + self.sheen(cos));
        dielectric + self.specular(wo, wi, h, cos) + DVec3::splat(self.coat(wo, wi, h, cos))
    }

    /// The base colour at luminance 1, white for black.
    fn tint(&self) -> DVec3 {
        let luminance = self.base_color.dot(LUMINANCE);
        if luminance > 0.0 { self.base_color / luminance } else { DVec3::ONE }
    }

    /// Reflectance at normal incidence, equation (21).
    fn f0(&self) -> DVec3 {
        let dielectric = ((self.eta - 1.0) / (self.eta + 1.0)).powi(2);
        let tint = DVec3::ONE.lerp(self.tint(), self.specular_tint);
        (1.0 - self.metallic) * dielectric * tint + self.metallic * self.base_color
    }

    /// Diffuse, retro-reflection and the subsurface approximation.
    fn base(&self, wo: DVec3, wi: DVec3, cos_d: f64) -> DVec3 {
        let diffuse = diffuse_and_retro(self.roughness, wo, wi, cos_d);
        self.base_color * lerp(diffuse, subsurface(self.roughness, wo, wi, cos_d), self.subsurface)
    }

    fn sheen(&self, cos_d: f64) -> DVec3 {
        let color = DVec3::ONE.lerp(self.tint(), self.sheen_tint);
        self.sheen * color * schlick_weight(cos_d)
    }

    fn specular(&self, wo: DVec3, wi: DVec3, h: DVec3, cos_d: f64) -> DVec3 {
        let f0 = self.f0();
        let fresnel = f0 + (DVec3::ONE - f0) * schlick_weight(cos_d);
        fresnel * (self.ggx.density(h) * self.ggx.visibility_separable(wo, wi))
    }

    fn coat(&self, wo: DVec3, wi: DVec3, h: DVec3, cos_d: f64) -> f64 {
        if self.clearcoat == 0.0 {
            return 0.0;
        }
        self.clearcoat * clearcoat(wo, wi, h, cos_d, self.coat_alpha())
    }

    fn coat_alpha(&self) -> f64 {
        lerp(0.1, 0.001, self.clearcoat_gloss)
    }

    pub(super) fn mixture(&self, wo: DVec3) -> Mixture {
        let weight = schlick_weight(wo.z);
        let f0 = self.f0().max_element();
        let base = (1.0 - self.metallic) * (self.base_color.max_element() + self.sheen * 0.2);
        let coat = 0.25 * self.clearcoat * lerp(0.04, 1.0, weight);
        // The subsurface shape is 1/(cosθi + cosθo) of even light where the viewer grazes.
        let even = 0.5 * self.subsurface * (1.0 - wo.z).max(0.0);
        let two = Mixture::two(base, f0 + (1.0 - f0) * weight, self.ggx);
        two.with_even(even).with_coat(coat, self.coat_alpha())
    }
}

/// Diffuse and retro-reflection of a white base.
pub(crate) fn diffuse_and_retro(roughness: f64, wo: DVec3, wi: DVec3, cos_d: f64) -> f64 {
    let (fl, fv) = (schlick_weight(wi.z), schlick_weight(wo.z));
    let diffuse = (1.0 - 0.5 * fl) * (1.0 - 0.5 * fv);
    let rr = 2.0 * roughness * cos_d * cos_d;
    FRAC_1_PI * (diffuse + rr * (fl + fv + fl * fv * (rr - 1.0)))
}

/// The subsurface approximation of a white base.
pub(crate) fn subsurface(roughness: f64, wo: DVec3, wi: DVec3, cos_d: f64) -> f64 {
    let (fl, fv) = (schlick_weight(wi.z), schlick_weight(wo.z));
    let fss90 = roughness * cos_d * cos_d;
    let fss = lerp(1.0, fss90, fl) * lerp(1.0, fss90, fv);
    1.25 * FRAC_1_PI * (fss * (1.0 / (wi.z + wo.z) - 0.5) + 0.5)
}

/// The clear coat at weight 1, with its Fresnel term and the model's quarter.
pub(crate) fn clearcoat(wo: DVec3, wi: DVec3, h: DVec3, cos_d: f64, alpha: f64) -> f64 {
    let masking = coat_masking(wo.z) * coat_masking(wi.z);
    0.25 * masking * lerp(0.04, 1.0, schlick_weight(cos_d)) * gtr1(h, alpha)
}

/// 1/(c + √(α² + c² − α²c²)).
fn coat_masking(cos: f64) -> f64 {
    let (a2, c2) = (CLEARCOAT_MASKING_ALPHA * CLEARCOAT_MASKING_ALPHA, cos * cos);
    1.0 / (cos + (a2 + c2 - a2 * c2).sqrt())
}

/// Generalised Trowbridge–Reitz of exponent 1, normalised like [`Ggx::density`]; 1/π at alpha ≥ 1.
pub(crate) fn gtr1(h: DVec3, alpha: f64) -> f64 {
    if alpha >= 1.0 {
        return FRAC_1_PI;
    }
    let a2 = alpha * alpha;
    let d = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    (a2 - 1.0) / (PI * a2.ln() * d)
}
