//! Area lights as they are usually written, in single and in double precision: Heitz et al. 2016, Heitz and Hill 2017.
//! glsl/probe/hard_area/usual.glsl and usual_ellipse.glsl are the same on the device.

use super::shapes::shapes;

/// Items twice, of floats and of doubles.
macro_rules! in_both_precisions {
    ($($item:item)*) => {
        pub(super) mod single {
            use glam::{Mat3 as Matrix, Vec3 as Vector, Vec4 as Slot};
            use std::f32::consts::PI;
            type Real = f32;
            super::shapes!();
            $($item)*
        }
        pub(super) mod double {
            use glam::{DMat3 as Matrix, DVec3 as Vector, DVec4 as Slot};
            use std::f64::consts::PI;
            type Real = f64;
            super::shapes!();
            $($item)*
        }
    };
}

in_both_precisions! {
    fn polygon(ring: &[Vector]) -> Real {
        let next = ring.iter().cycle().skip(1);
        let mut above = Vec::new();
        for (&a, &b) in ring.iter().zip(next) {
            if a.z >= 0.0 {
                above.push(a.normalize());
            }
            if (a.z >= 0.0) != (b.z >= 0.0) {
                above.push((b.z.abs() * a + a.z.abs() * b).normalize());
            }
        }
        let next = above.iter().cycle().skip(1);
        let term = |(u, v): (&Vector, &Vector)| u.dot(*v).acos() * u.cross(*v).normalize().z;
        -0.5 / PI * above.iter().zip(next).map(term).sum::<Real>()
    }

    pub(in super::super) fn form_factor(slots: &[Slot; 4]) -> Real {
        polygon(&corners(slots))
    }

    pub(in super::super) fn parts(slots: &[Slot; 4]) -> Real {
        quarters(slots).iter().map(|quarter| polygon(quarter)).sum()
    }

    pub(in super::super) fn notch(slots: &[Slot; 4]) -> Real {
        polygon(&notched(slots))
    }

    pub(in super::super) fn hole(slots: &[Slot; 4]) -> Real {
        (polygon(&parallelogram(slots, 1.0)) - polygon(&parallelogram(slots, slots[3].x))).abs()
    }

    pub(in super::super) fn line(&[a, b, radius, _]: &[Slot; 4]) -> Real {
        let [mut a, mut b] = [a, b].map(|end| end.truncate());
        if a.z <= 0.0 && b.z <= 0.0 {
            return 0.0;
        }
        if a.z < 0.0 {
            a = (a * b.z - b * a.z) / (b.z - a.z);
        }
        if b.z < 0.0 {
            b = (b * a.z - a * b.z) / (a.z - b.z);
        }
        let along = (b - a).normalize();
        let foot = a - a.dot(along) * along;
        let d = foot.length();
        let antiderivative = |end: Vector| {
            let l = end.dot(along);
            let all = d * (d * d + l * l);
            (l / all + (l / d).atan() / (d * d)) * foot.z + l * l / all * along.z
        };
        radius.x / PI * (antiderivative(b) - antiderivative(a))
    }

    pub(in super::super) fn furnace(&[wo, shape, stretch, _]: &[Slot; 4]) -> Real {
        let y = Vector::Z.cross(wo.truncate()).normalize();
        let z = Vector::new(-wo.x, -wo.y, wo.z);
        let frame = Matrix::from_cols(y.cross(z), y, z);
        let [b, c, d] = [shape.y, shape.z, shape.w].map(|number| stretch.x * number);
        let map = Matrix::from_cols_array(&[shape.x, 0.0, c, 0.0, 1.0, 0.0, b, 0.0, d]) * frame.transpose();
        cube().iter().map(|side| polygon(&side.map(|corner| map * corner))).sum()
    }

    pub(in super::super) fn incidence(&[wo, n, _, _]: &[Slot; 4]) -> Real {
        let [wo, n] = [wo, n].map(|v| v.truncate());
        wo.dot((wo - n * wo.dot(n)).normalize())
    }

    pub(in super::super) fn coordinate(&[wo, n, _, _]: &[Slot; 4]) -> Real {
        let two: Real = 2.0;
        two.sqrt() * (0.5 * wo.truncate().dot(n.truncate()).acos()).sin()
    }

    /// Of x³ + c[2] x² + c[1] x + c[0], from the largest down.
    fn roots(c: [Real; 3]) -> [Real; 3] {
        let p = (c[2] * c[2] - 3.0 * c[1]) / 9.0;
        let h = (9.0 * c[2] * c[1] - 27.0 * c[0] - 2.0 * c[2] * c[2] * c[2]) / 54.0;
        let angle = (p * p * p - h * h).sqrt().atan2(h) / 3.0;
        let third = 2.0 * PI / 3.0;
        [angle, angle - third, angle + third].map(|angle| 2.0 * p.sqrt() * angle.cos() - c[2] / 3.0)
    }

    /// Lagarde and de Rousiers 2014, of a sphere of sin² `size` at this cosine.
    fn sphere(cosine: Real, size: Real) -> Real {
        if cosine * cosine > size {
            return size * cosine.max(0.0);
        }
        let sine = (1.0 - cosine * cosine).sqrt();
        let x = (1.0 / size - 1.0).sqrt();
        let y = -x * cosine / sine;
        let s = sine * (1.0 - y * y).sqrt();
        ((cosine * y.acos() - x * s) * size + (s / x).atan()) / PI
    }

    pub(in super::super) fn ellipse(&[center, a, b, _]: &[Slot; 4]) -> Real {
        let [center, a, b] = [center, a, b].map(|v| v.truncate());
        let (x, y) = (a.normalize(), b.normalize());
        let across = x.cross(y);
        let z = if across.dot(center) < 0.0 { -across } else { across };
        let d = z.dot(center);
        let at = [x.dot(center) / d, y.dot(center) / d];
        let inverse2 = [d * d / a.length_squared(), d * d / b.length_squared()];
        let product = inverse2[0] * inverse2[1];
        let stretch = inverse2[0] * (1.0 + at[0] * at[0]) + inverse2[1] * (1.0 + at[1] * at[1]);
        let middle = product * (1.0 + at[0] * at[0] + at[1] * at[1]) - inverse2[0] - inverse2[1];
        let [first, second, last] = roots([product, middle, 1.0 - stretch]);
        let lean = [0, 1].map(|i| inverse2[i] * at[i] / (inverse2[i] - last));
        let axis = (lean[0] * x + lean[1] * y + z).normalize();
        let size2 = [-last / first, -last / second];
        let size = (size2[0] * size2[1] / ((1.0 + size2[0]) * (1.0 + size2[1]))).sqrt();
        sphere(axis.z, size)
    }
}
