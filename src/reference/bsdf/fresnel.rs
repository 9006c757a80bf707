//! Exact Fresnel reflectances of unpolarised light, and Schlick's approximation.

/// Dielectric reflectance for incidence from the side of index 1 onto index `eta`, equations (6), (8), (9).
///
/// `cos` in [0, 1]. Total internal reflection (eta < 1) gives 1, eta = 1 gives 0 at every angle.
#[must_use]
pub fn dielectric(cos: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let sin2_t = (1.0 - cos * cos) / (eta * eta);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2_t).sqrt();
    let s = (cos - eta * cos_t) / (cos + eta * cos_t);
    let p = (eta * cos - cos_t) / (eta * cos + cos_t);
    0.5 * (s * s + p * p)
}

/// Conductor reflectance for incidence from air onto the complex index `eta` + i`k`, equations (10), (11).
///
/// a and b are the real and imaginary parts of √((η + ik)² − sin²θ). Where a² would cancel (η² < k² + sin²θ), b is
/// taken first and a = ηk/b.
#[must_use]
pub fn conductor(cos: f64, eta: f64, k: f64) -> f64 {
    let sin2 = 1.0 - cos * cos;
    let difference = eta * eta - k * k - sin2;
    let modulus = difference.hypot(2.0 * eta * k);
    let (a, b) = if difference < 0.0 {
        let b = (0.5 * (modulus - difference)).sqrt();
        (eta * k / b, b)
    } else {
        let a = (0.5 * (modulus + difference)).sqrt();
        (a, if a > 0.0 { eta * k / a } else { 0.0 })
    };
    let s = ((a - cos).powi(2) + b * b) / ((a + cos).powi(2) + b * b);
    let below = (cos * a + sin2).powi(2) + (cos * b).powi(2);
    if below == 0.0 {
        // eta = k = 0 at normal incidence: no refracted wave.
        return 1.0;
    }
    let p = s * ((cos * a - sin2).powi(2) + (cos * b).powi(2)) / below;
    0.5 * (s + p)
}

/// Schlick's weight (1 − c)⁵, the argument clamped to [0, 1].
pub(crate) fn schlick_weight(cos: f64) -> f64 {
    super::pow5((1.0 - cos).clamp(0.0, 1.0))
}
