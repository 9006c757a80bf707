//! The anisotropic Trowbridge–Reitz (GGX) distribution with Smith masking, equations (3)–(5), (20).

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

/// Trowbridge–Reitz with the raw alphas of both axes, each ≥ 1e-3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// Alpha along the tangent.
    pub alpha_x: f64,
    /// Alpha across it.
    pub alpha_y: f64,
}

impl Ggx {
    /// The same alpha in every direction.
    #[must_use]
    pub const fn isotropic(alpha: f64) -> Self {
        Self { alpha_x: alpha, alpha_y: alpha }
    }

    /// D(h), normalised by ∫ D(h)(n·h) dh = 1.
    #[must_use]
    pub fn density(&self, h: DVec3) -> f64 {
        let (x, y) = (h.x / self.alpha_x, h.y / self.alpha_y);
        let d = x * x + y * y + h.z * h.z;
        1.0 / (PI * self.alpha_x * self.alpha_y * d * d)
    }

    /// L(w) = √((αx wx)² + (αy wy)² + wz²).
    pub(super) fn stretched_length(&self, w: DVec3) -> f64 {
        self.stretch(w).length()
    }

    fn stretch(&self, w: DVec3) -> DVec3 {
        DVec3::new(self.alpha_x * w.x, self.alpha_y * w.y, w.z)
    }

    /// V = G/(4 cosi coso) with height-correlated masking and shadowing.
    #[must_use]
    pub fn visibility_correlated(&self, wo: DVec3, wi: DVec3) -> f64 {
        let sum = wi.z * self.stretched_length(wo) + wo.z * self.stretched_length(wi);
        0.5 / sum.max(1e-20)
    }

    /// V = G/(4 cosi coso) with independent masking and shadowing.
    #[must_use]
    pub fn visibility_separable(&self, wo: DVec3, wi: DVec3) -> f64 {
        1.0 / ((wo.z + self.stretched_length(wo)) * (wi.z + self.stretched_length(wi)))
    }

    /// A normal visible from `wo` (Heitz 2018, *Sampling the GGX Distribution of Visible Normals*).
    pub(crate) fn sample_visible_normal(&self, wo: DVec3, xi: DVec2) -> DVec3 {
        let v = self.stretch(wo).normalize();
        let across = DVec2::new(v.x, v.y).length();
        let t1 = if across > 1e-15 { DVec3::new(-v.y, v.x, 0.0) / across } else { DVec3::X };
        let t2 = v.cross(t1);
        let (r, phi) = (xi.x.sqrt(), 2.0 * PI * xi.y);
        let p1 = r * phi.cos();
        // The projected hemisphere is a half disk and a half ellipse: squeeze the second coordinate into it.
        let s = 0.5 * (1.0 + v.z);
        let p2 = (1.0 - s) * (1.0 - p1 * p1).max(0.0).sqrt() + s * r * phi.sin();
        let n = p1 * t1 + p2 * t2 + (1.0 - p1 * p1 - p2 * p2).max(0.0).sqrt() * v;
        DVec3::new(self.alpha_x * n.x, self.alpha_y * n.y, n.z.max(0.0)).normalize()
    }

    /// Density per solid angle of the reflection about [`Ggx::sample_visible_normal`]: G1(wo) D(h)/(4 coso).
    pub(crate) fn pdf(&self, wo: DVec3, wi: DVec3) -> f64 {
        let (h, _) = super::half_vector(wo, wi);
        self.density(h) / (2.0 * (wo.z + self.stretched_length(wo)))
    }
}
