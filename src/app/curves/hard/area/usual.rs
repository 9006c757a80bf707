//! Area lights as they are usually written, in single and in double precision: Heitz et al. 2016, Heitz and Hill 2017, by
//! the same steps as the shaders that they published. glsl/probe/hard_area/usual.glsl and usual_ellipse.glsl are the same
//! on the device.

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
    /// An angle over its sine that is 1 up to .001, and where acos has no number.
    fn edge(u: Vector, v: Vector) -> Real {
        let angle = u.dot(v).acos();
        u.cross(v).z * if angle > 0.001 { angle / angle.sin() } else { 1.0 }
    }

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
        -0.5 / PI * above.iter().zip(next).map(|(&u, &v)| edge(u, v)).sum::<Real>()
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

    /// The largest and the smallest root of y³ + 3 p y + q, from p, −q and the root of −4 p³ − q²: all three are real.
    fn outer_roots(p: Real, lead: Real, sine: Real) -> [Real; 2] {
        let angle = sine.atan2(lead) / 3.0;
        [angle, angle + 2.0 * PI / 3.0].map(|angle| 2.0 * (-p).sqrt() * angle.cos())
    }

    /// Of x³ + 3 b x² + 3 c x + d, from the largest down. Blinn 2007, «How to Solve a Cubic Equation», part 5: the root
    /// farthest from 0 by the equation, the nearest by its reverse, which is for −d/x, and the third from both: by one
    /// angle for all three the small ones would be differences of large numbers.
    fn roots([b, c, d]: [Real; 3]) -> [Real; 3] {
        let hessian = [c - b * b, d - b * c, b * d - c * c];
        let sine = (4.0 * hessian[0] * hessian[2] - hessian[1] * hessian[1]).sqrt();
        let [high, low] = outer_roots(hessian[0], 2.0 * b * hessian[0] - hessian[1], sine);
        let far = if high + low > 2.0 * b { high } else { low } - b;
        let [high, low] = outer_roots(hessian[2], d * hessian[1] - 2.0 * c * hessian[2], d * sine);
        let near = -d / (if high + low < 2.0 * c { high } else { low } + c);
        let (sum, product) = (far + near, far * near);
        let mut all = [far, -(c * sum + b * product) / (c + b * sum), near];
        all.sort_by(|x, y| y.total_cmp(x));
        all
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
        let [first, second, last] = roots([(1.0 - stretch) / 3.0, middle / 3.0, product]);
        let lean = [0, 1].map(|i| inverse2[i] * at[i] / (inverse2[i] - last));
        let axis = (lean[0] * x + lean[1] * y + z).normalize();
        let size2 = [-last / first, -last / second];
        let size = (size2[0] * size2[1] / ((1.0 + size2[0]) * (1.0 + size2[1]))).sqrt();
        sphere(axis.z, size)
    }
}
