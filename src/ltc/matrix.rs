//! The transformed cosine: four numbers, the basis that they stand in, and the density that they make.

use std::f64::consts::FRAC_1_PI;

use glam::{DMat3, DVec3};

use super::{Frame, Lobe};

/// The four numbers of a texel, (a, b, c, d).
pub type Shape = [f64; 4];

/// The basis of a lobe's matrix, and the factor that is divided out of it: [`super::Layer::stretch`].
#[derive(Clone, Copy, Debug)]
pub struct Basis {
    /// Rows X, Y, Z in the local frame; Y is its y.
    pub axes: DMat3,
    /// What b, and what c and d, are multiplied with.
    pub stretch: f64,
}

impl Basis {
    /// The basis of `frame` for this lobe.
    #[must_use]
    pub fn new(frame: Frame, lobe: &Lobe) -> Self {
        match frame {
            Frame::Mirror => {
                let (sin, cos) = (lobe.wo.x, lobe.wo.z);
                let rows = [DVec3::new(cos, 0.0, sin), DVec3::Y, DVec3::new(-sin, 0.0, cos)];
                let axes = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
                Self { axes, stretch: lobe.layer.stretch(lobe.alpha) }
            }
            Frame::Normal => Self { axes: DMat3::IDENTITY, stretch: 1.0 },
        }
    }

    /// The inverse matrix in the local frame, up to scale.
    #[must_use]
    pub fn inverse(&self, shape: Shape) -> DMat3 {
        let [a, b, c, d] = shape;
        let t = self.stretch;
        let rows = DMat3::from_cols_array(&[a, 0.0, t * b, 0.0, 1.0, 0.0, t * c, 0.0, t * d]);
        rows.transpose() * self.axes
    }
}

/// Density per solid angle of the cosine lobe transformed by the inverse of `inverse`, at the unit vector `w`.
#[must_use]
pub fn density(inverse: &DMat3, w: DVec3) -> f64 {
    let q = *inverse * w;
    let q2 = q.length_squared();
    FRAC_1_PI * q.z.max(0.0) * inverse.determinant() / (q2 * q2)
}

/// Share of the transformed cosine that lies below the surface: (1 − cos γ)/2, γ the angle between z and Mᵀn.
#[must_use]
pub fn leak(inverse: &DMat3) -> f64 {
    // Mᵀn is the normal's row of the cofactors of M⁻¹, over its determinant.
    let normal = inverse.x_axis.cross(inverse.y_axis) / inverse.determinant();
    0.5 * (1.0 - normal.z / normal.length())
}
