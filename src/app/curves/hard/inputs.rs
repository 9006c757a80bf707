//! Random numbers and directions of which cases are made.

use crate::reference::sampler::Random;
use glam::DVec3;

/// By equal ratios.
pub(super) fn ratio(random: &mut Random, least: f64, most: f64) -> f64 {
    least * (most / least).powf(random.next())
}

/// With this cosine to +z, at any azimuth.
pub(super) fn at_cosine(random: &mut Random, cosine: f64) -> DVec3 {
    let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
    let radius = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    DVec3::new(radius * cos, radius * sin, cosine)
}

pub(super) fn above(random: &mut Random) -> DVec3 {
    let cosine = 0.05 + 0.95 * random.next();
    at_cosine(random, cosine)
}

/// Two directions of this angle.
pub(super) fn apart(random: &mut Random, wo: DVec3, angle: f64) -> DVec3 {
    let across = wo.any_orthonormal_vector();
    let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
    let side = cos * across + sin * wo.cross(across);
    (angle.cos() * wo + angle.sin() * side).normalize()
}
