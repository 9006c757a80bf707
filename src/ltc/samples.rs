//! Deterministic directions with weights, over which a lobe and a transformed cosine are compared.
//!
//! A mixture (balance heuristic) of the lobe's own half vectors, wider ones, and directions over the whole hemisphere;
//! each by a Kronecker sequence. Both lobes are the same on either side of the plane of incidence, so directions stand
//! for their mirror image too.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::{DVec2, DVec3};

use super::{Basis, Frame, Layer, Lobe};
use crate::reference::bsdf::{Ggx, half_vector, principled, sampling};

/// 1/φ, the most even Kronecker sequence.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A density to draw directions from.
#[derive(Clone, Copy)]
enum Proposal {
    Visible(Ggx),
    Gtr1(f64),
    Cosine,
    Uniform,
}

impl Proposal {
    fn sample(self, wo: DVec3, xi: DVec2) -> DVec3 {
        let reflect = |h: DVec3| 2.0 * wo.dot(h) * h - wo;
        match self {
            Self::Visible(ggx) => reflect(ggx.sample_visible_normal(wo, xi)),
            Self::Gtr1(alpha) => reflect(sampling::gtr1_normal(alpha, xi)),
            Self::Cosine => sampling::cosine(xi),
            Self::Uniform => {
                let (sin, phi) = ((1.0 - xi.x * xi.x).sqrt(), 2.0 * PI * xi.y);
                DVec3::new(sin * phi.cos(), sin * phi.sin(), xi.x)
            }
        }
    }

    fn pdf(self, wo: DVec3, wi: DVec3) -> f64 {
        match self {
            Self::Visible(ggx) => ggx.pdf(wo, wi),
            Self::Gtr1(alpha) => {
                let (h, cos) = half_vector(wo, wi);
                principled::gtr1(h, alpha) * h.z / (4.0 * cos)
            }
            Self::Cosine => wi.z * FRAC_1_PI,
            Self::Uniform => 0.5 * FRAC_1_PI,
        }
    }
}

/// Proposals of a lobe with their shares.
fn proposals(lobe: &Lobe) -> Vec<(Proposal, f64)> {
    let wide = |factor: f64| Proposal::Visible(Ggx::isotropic((factor * lobe.alpha).min(1.0)));
    match lobe.layer.frame() {
        Frame::Normal => vec![(Proposal::Cosine, 0.5), (Proposal::Uniform, 0.5)],
        Frame::Mirror if lobe.layer == Layer::Clearcoat => vec![
            (Proposal::Gtr1(lobe.alpha), 0.5),
            (wide(4.0), 0.2),
            (Proposal::Cosine, 0.15),
            (Proposal::Uniform, 0.15),
        ],
        Frame::Mirror => {
            vec![(wide(1.0), 0.6), (wide(3.0), 0.2), (Proposal::Cosine, 0.1), (Proposal::Uniform, 0.1)]
        }
    }
}

/// Directions above the surface in the basis of the lobe's matrix.
pub(super) struct Samples {
    /// Direction in the basis.
    pub(super) directions: Vec<DVec3>,
    /// Solid angle that the direction stands for.
    pub(super) weights: Vec<f64>,
    /// The lobe there, sr⁻¹.
    pub(super) lobe: Vec<f64>,
}

impl Samples {
    /// About `count` directions for `lobe`.
    pub(super) fn new(lobe: &Lobe, basis: &Basis, count: usize) -> Self {
        let proposals = proposals(lobe);
        let (mut directions, mut weights, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (proposal, share) in &proposals {
            let own = (share * count as f64) as usize;
            for i in 0..own {
                let xi = DVec2::new((i as f64 + 0.5) / own as f64, (i as f64 * GOLDEN).fract());
                let wi = proposal.sample(lobe.wo, xi).normalize();
                if wi.z <= 0.0 {
                    continue;
                }
                let pdf: f64 = proposals.iter().map(|(other, share)| share * other.pdf(lobe.wo, wi)).sum();
                directions.push(basis.axes * wi);
                weights.push(1.0 / (pdf * count as f64));
                values.push(lobe.eval(wi));
            }
        }
        Self { directions, weights, lobe: values }
    }

    /// ∫ lobe by these samples.
    pub(super) fn mass(&self) -> f64 {
        self.weights.iter().zip(&self.lobe).map(|(weight, value)| weight * value).sum()
    }
}
