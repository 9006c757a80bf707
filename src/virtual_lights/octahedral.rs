//! Unit vectors and cones in 32 bits (Cigolle et al. 2014, *A Survey of Efficient Representations for Independent Unit
//! Vectors*).

use glam::{DVec2, DVec3};

/// Largest coordinate of a normal's code, as of `unpackSnorm2x16`.
const NORMAL_UNITS: f64 = 32767.0;
/// Largest coordinate of the code of a cone's axis.
const AXIS_UNITS: f64 = 2047.0;
/// Bits of such a coordinate.
const AXIS_BITS: u32 = 12;
/// Largest code of a cosine.
const COSINE_UNITS: f64 = 255.0;

/// A unit normal as [`VirtualLight::normal`](crate::shared::VirtualLight::normal), to within 7e-5 radians.
#[must_use]
pub fn pack_normal(normal: DVec3) -> u32 {
    let [x, y] = to_units(normal, NORMAL_UNITS);
    (x as u32 & 0xffff) | (y as u32) << 16
}

/// The normal of such a code; not of `VIRTUAL_ISOTROPIC`.
#[must_use]
pub fn unpack_normal(code: u32) -> DVec3 {
    from_units([code as u16 as i16, (code >> 16) as u16 as i16].map(i32::from), NORMAL_UNITS)
}

/// Directions within an angle of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit.
    pub axis: DVec3,
    /// Half the angle at the apex, radians, up to π.
    pub angle: f64,
}

impl Cone {
    /// All directions.
    pub const SPHERE: Self = Self { axis: DVec3::Z, angle: std::f64::consts::PI };

    /// One direction.
    #[must_use]
    pub fn along(axis: DVec3) -> Self {
        Self { axis, angle: 0.0 }
    }

    /// The smallest cone around two.
    #[must_use]
    pub fn around(self, other: Self) -> Self {
        let (wide, narrow) = if self.angle >= other.angle { (self, other) } else { (other, self) };
        if wide.axis == narrow.axis {
            return wide;
        }
        // As exact for small angles as for large ones, unlike the arc cosine.
        let across = wide.axis.cross(narrow.axis);
        let between = across.length().atan2(wide.axis.dot(narrow.axis));
        if between + narrow.angle <= wide.angle {
            return wide;
        }
        let angle = 0.5 * (wide.angle + between + narrow.angle);
        let Some(turn) = across.cross(wide.axis).try_normalize().filter(|_| angle < Self::SPHERE.angle)
        else {
            return Self::SPHERE;
        };
        let (sin, cos) = (angle - wide.angle).sin_cos();
        Self { axis: (cos * wide.axis + sin * turn).normalize(), angle }
    }

    /// As [`VirtualPair::left_cone`](crate::shared::VirtualPair::left_cone): what it decodes to holds this one. Cones of more than
    /// a hemisphere become the whole sphere.
    #[must_use]
    pub fn pack(self) -> u32 {
        let [x, y] = to_units(self.axis, AXIS_UNITS);
        let axis = from_units([x, y], AXIS_UNITS);
        // The axis' rounding widens the cone: the cosine of the sum of both angles.
        let (sin_error, cos_error) = (axis.cross(self.axis).length(), axis.dot(self.axis));
        let (sin, cos) = self.angle.sin_cos();
        // An axis along one of the space's is exact, and with it the cone of a wall.
        let slack = if sin_error == 0.0 && self.angle == 0.0 { 0.0 } else { 1e-12 };
        let cosine = ((cos * cos_error - sin * sin_error - slack).max(0.0) * COSINE_UNITS).floor();
        let mask = (1 << AXIS_BITS) - 1;
        (x as u32 & mask) | (y as u32 & mask) << AXIS_BITS | (cosine as u32) << (2 * AXIS_BITS)
    }

    /// The cone of such a code.
    #[must_use]
    pub fn unpack(code: u32) -> Self {
        let cosine = f64::from(code >> (2 * AXIS_BITS)) / COSINE_UNITS;
        if cosine == 0.0 {
            return Self::SPHERE;
        }
        // Shifts the number's sign to the top and back.
        let coordinate = |shift: u32| (code << (32 - AXIS_BITS - shift)) as i32 >> (32 - AXIS_BITS);
        Self { axis: from_units([coordinate(0), coordinate(AXIS_BITS)], AXIS_UNITS), angle: cosine.acos() }
    }
}

/// 1 with the sign of each coordinate, also of 0.
fn signs(p: DVec2) -> DVec2 {
    DVec2::select(p.cmpge(DVec2::ZERO), DVec2::ONE, DVec2::NEG_ONE)
}

fn fold(p: DVec2) -> DVec2 {
    (DVec2::ONE - DVec2::new(p.y, p.x).abs()) * signs(p)
}

fn to_units(n: DVec3, units: f64) -> [i32; 2] {
    let flat = n.truncate() / n.abs().element_sum();
    let place = if n.z < 0.0 { fold(flat) } else { flat };
    (place * units).round().to_array().map(|v| v as i32)
}

fn from_units(code: [i32; 2], units: f64) -> DVec3 {
    let flat = DVec2::from_array(code.map(f64::from)) / units;
    let z = 1.0 - flat.abs().element_sum();
    (if z < 0.0 { fold(flat) } else { flat }).extend(z).normalize()
}
