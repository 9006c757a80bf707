//! Flat lights in the coordinates of their half axes.

use crate::scene::luminaire::fitted;
use glam::{DVec2, DVec3, Vec3};

/// (0, 0) at center − u − v, (1, 1) at center + u + v.
const RECT_UV: [DVec3; 2] = [DVec3::new(0.5, 0.0, 0.5), DVec3::new(0.0, 0.5, 0.5)];

/// A plane with half axes: center + s u + t v.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) center: DVec3,
    pub(super) u: DVec3,
    pub(super) v: DVec3,
    /// (s, t, 1) to texture coordinates.
    pub(super) uv: [DVec3; 2],
    pub(super) outline: Outline,
}

/// What of the plane shines, in (s, t).
#[derive(Clone, Debug)]
pub(super) enum Outline {
    /// The whole of [−1, 1]².
    Parallelogram,
    /// s² + t² ≤ 1.
    Ellipse,
    /// A counter-clockwise loop, and clockwise holes.
    Loops(Vec<Vec<DVec2>>),
}

impl Plane {
    /// center ± u ± v, or what of it lies in the ellipse.
    pub(super) fn new([center, u, v]: [Vec3; 3], outline: Outline) -> Self {
        let [center, u, v] = [center, u, v].map(|v| v.as_dvec3());
        Self { center, u, v, uv: RECT_UV, outline }
    }

    /// A polygon in its bounding rectangle along its first edge.
    pub(super) fn polygon(vertices: &[Vec3], holes: &[Vec<Vec3>], uvs: Option<&[[f32; 2]]>) -> Self {
        let outer: Vec<_> = vertices.iter().map(|p| p.as_dvec3()).collect();
        let first = outer.first().copied().unwrap_or_default();
        let edges = || outer.iter().zip(outer.iter().cycle().skip(1));
        let normal: DVec3 = edges().map(|(a, b)| (a - first).cross(b - first)).sum();
        let normal = normal.normalize_or(DVec3::Z);
        let along = edges().find_map(|(a, b)| (b - a).try_normalize());
        let x = along.unwrap_or_else(|| normal.any_orthonormal_vector());
        let y = normal.cross(x);
        let flat = |p: DVec3| DVec2::new((p - first).dot(x), (p - first).dot(y));
        let low = outer.iter().map(|&p| flat(p)).fold(DVec2::INFINITY, DVec2::min);
        let high = outer.iter().map(|&p| flat(p)).fold(DVec2::NEG_INFINITY, DVec2::max);
        let (middle, half) = (0.5 * (low + high), (0.5 * (high - low)).max(DVec2::splat(f64::MIN_POSITIVE)));
        let to_st = |p: &Vec3| (flat(p.as_dvec3()) - middle) / half;
        let wound = |points: &[Vec3], counter_clockwise: bool| {
            let mut points: Vec<_> = points.iter().map(to_st).collect();
            if (area(&points) > 0.0) != counter_clockwise {
                points.reverse();
            }
            points
        };
        let outline: Vec<_> = vertices.iter().map(to_st).collect();
        let uv = uvs.map_or(RECT_UV, |uvs| fitted(&outline, uvs));
        let loops = std::iter::once(outline).chain(holes.iter().map(|hole| wound(hole, false))).collect();
        Self {
            center: first + middle.x * x + middle.y * y,
            u: half.x * x,
            v: half.y * y,
            uv,
            outline: Outline::Loops(loops),
        }
    }

    pub(super) fn at(&self, st: DVec2) -> DVec3 {
        self.center + st.x * self.u + st.y * self.v
    }

    pub(super) fn uv_at(&self, st: DVec2) -> DVec2 {
        DVec2::from_array(self.uv.map(|row| row.dot(st.extend(1.0))))
    }

    /// Square metres of a unit of area in (s, t).
    pub(super) fn scale(&self) -> f64 {
        self.u.cross(self.v).length()
    }

    /// The light's rings in (s, t); none of an ellipse.
    pub(super) fn rings(&self) -> Vec<Vec<DVec2>> {
        match &self.outline {
            Outline::Parallelogram => {
                vec![[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(DVec2::from_array).into()]
            }
            Outline::Ellipse => Vec::new(),
            Outline::Loops(loops) => loops.clone(),
        }
    }

    /// Radius about the centre.
    pub(super) fn extent(&self) -> f64 {
        let rim = match &self.outline {
            Outline::Ellipse => return longest_axis(self.u, self.v),
            Outline::Parallelogram | Outline::Loops(_) => self.rings(),
        };
        rim.iter().flatten().map(|&st| (self.at(st) - self.center).length()).fold(0.0, f64::max)
    }
}

/// The longer principal half axis of the ellipse u cos φ + v sin φ.
fn longest_axis(u: DVec3, v: DVec3) -> f64 {
    let (a, b) = (u.length_squared() + v.length_squared(), u.length_squared() - v.length_squared());
    (0.5 * (a + b.hypot(2.0 * u.dot(v)))).sqrt()
}

/// Signed area of a loop.
pub(super) fn area(points: &[DVec2]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
}
