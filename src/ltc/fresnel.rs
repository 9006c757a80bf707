//! Any Fresnel curve as a weighted sum of the three whose integrals a table stores: its albedo is then the same sum of
//! those, at every roughness and angle.

use crate::reference::bsdf::fresnel::schlick_weight;
use crate::reference::bsdf::{fresnel_conductor, fresnel_dielectric};

use super::PLASTIC_ETAS;

/// Cosines at which a curve is matched.
const POINTS: usize = 256;

/// Weights of plastic's three albedos ([`PLASTIC_ETAS`]) that give the albedo at index `eta` in [1.1, 2.5].
#[must_use]
pub fn project_dielectric(eta: f64) -> [f64; 3] {
    // An error counts relative to the curve, as it will in the picture.
    project(|cos| fresnel_dielectric(cos, eta), |cos| PLASTIC_ETAS.map(|eta| fresnel_dielectric(cos, eta)))
}

/// Weights of (A0, A5, A82) that give the albedo of a conductor of index `eta` + i`k`.
#[must_use]
pub fn project_conductor(eta: f64, k: f64) -> [f64; 3] {
    project(|cos| fresnel_conductor(cos, eta, k), |cos| [1.0, schlick_weight(cos), cos * (1.0 - cos).powi(6)])
}

/// Least squares of the relative error, over cosines as densely as over solid angle.
fn project(curve: impl Fn(f64) -> f64, basis: impl Fn(f64) -> [f64; 3]) -> [f64; 3] {
    let (mut matrix, mut right) = (glam::DMat3::ZERO, glam::DVec3::ZERO);
    for i in 0..POINTS {
        let cos = (i as f64 + 0.5) / POINTS as f64;
        let target = curve(cos).max(1e-6);
        let row = glam::DVec3::from_array(basis(cos)) / target;
        matrix += glam::DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        right += row;
    }
    (matrix.inverse() * right).to_array()
}
