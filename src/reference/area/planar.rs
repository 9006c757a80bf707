//! Flat lights: parallelograms, ellipses, and polygons with holes.

use glam::{DMat3, DVec2, DVec3, Vec3};

use super::Seen;
use crate::reference::sampler::concentric_disk;

/// A flat outline in the coordinates (s, t) ∈ [−1, 1]² of a parallelogram: center + s u + t v.
#[derive(Clone, Debug)]
pub(super) struct Planar {
    center: DVec3,
    u: DVec3,
    v: DVec3,
    /// Unit, towards the front.
    normal: DVec3,
    /// Vectors that give s and t by a dot product.
    dual: [DVec3; 2],
    outline: Outline,
    /// (s, t, 1) to texture coordinates.
    uv: [DVec3; 2],
}

#[derive(Clone, Debug)]
enum Outline {
    /// The whole parallelogram.
    Parallelogram,
    /// s² + t² ≤ 1.
    Ellipse,
    /// Inside an odd number of loops. Sampled over the whole rectangle, radiance 0 outside: holes cost noise only.
    Loops(Vec<Vec<DVec2>>),
}

/// (0, 0) at center − u − v, (1, 1) at center + u + v.
const RECT_UV: [DVec3; 2] = [DVec3::new(0.5, 0.0, 0.5), DVec3::new(0.0, 0.5, 0.5)];

impl Planar {
    fn new(center: DVec3, u: DVec3, v: DVec3, outline: Outline) -> Self {
        let normal = u.cross(v).normalize_or_zero();
        let (across_v, across_u) = (v.cross(normal), u.cross(normal));
        let dual = [across_v / u.dot(across_v), across_u / v.dot(across_u)];
        Self { center, u, v, normal, dual, outline, uv: RECT_UV }
    }

    /// center ± u ± v.
    pub(super) fn rect(center: DVec3, u: DVec3, v: DVec3) -> Self {
        Self::new(center, u, v, Outline::Parallelogram)
    }

    /// center + u cos φ + v sin φ.
    pub(super) fn ellipse(center: DVec3, u: DVec3, v: DVec3) -> Self {
        Self::new(center, u, v, Outline::Ellipse)
    }

    /// A polygon in its bounding rectangle along the first edge.
    pub(super) fn polygon(vertices: &[Vec3], holes: &[Vec<Vec3>], uvs: Option<&[[f32; 2]]>) -> Self {
        let outer: Vec<_> = vertices.iter().map(|p| p.as_dvec3()).collect();
        let next = outer.iter().cycle().skip(1);
        let edge = |(a, b): (&DVec3, &DVec3)| (b - a).try_normalize();
        let s_axis = outer.iter().zip(next).find_map(edge).unwrap_or(DVec3::X);
        let normal = newell_normal(&outer);
        let t_axis = normal.cross(s_axis);
        let on_axes = |p: DVec3| DVec2::new((p - outer[0]).dot(s_axis), (p - outer[0]).dot(t_axis));
        let flat = outer.iter().map(|&p| on_axes(p));
        let (min, max) =
            flat.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
        let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
        let loops = std::iter::once(vertices).chain(holes.iter().map(Vec::as_slice));
        let to_st = |p: &Vec3| (on_axes(p.as_dvec3()) - middle) / half;
        let loops = loops.map(|l| l.iter().map(to_st).collect()).collect::<Vec<Vec<_>>>();
        let uv = uvs.map(|uvs| affine_uv(&loops[0], uvs));
        let center = outer[0] + middle.x * s_axis + middle.y * t_axis;
        let planar = Self::new(center, half.x * s_axis, half.y * t_axis, Outline::Loops(loops));
        Self { uv: uv.unwrap_or(RECT_UV), ..planar }
    }

    /// Height of the highest point above the plane through `origin` with the unit normal, and whether the front is seen
    /// from there. Of a polygon that of its rectangle, which is not less.
    pub(super) fn highest(&self, origin: DVec3, normal: DVec3) -> (f64, bool) {
        let [u, v] = [self.u, self.v].map(|axis| axis.dot(normal).abs());
        let reach = if matches!(self.outline, Outline::Ellipse) { u.hypot(v) } else { u + v };
        ((self.center - origin).dot(normal) + reach, (origin - self.center).dot(self.normal) > 0.0)
    }

    /// Centre, squared radius and area of the parallelogram.
    pub(super) fn extent(&self) -> (DVec3, f64, f64) {
        let size2 = self.u.length_squared() + self.v.length_squared();
        (self.center, size2, 4.0 * self.u.cross(self.v).length())
    }

    /// A point of the outline or, for loops, of the rectangle: then possibly none.
    pub(super) fn sample(&self, origin: DVec3, xi: DVec2) -> Option<Seen> {
        let st = match self.outline {
            Outline::Ellipse => concentric_disk(xi),
            Outline::Parallelogram | Outline::Loops(_) => 2.0 * xi - DVec2::ONE,
        };
        let to_light = self.center + st.x * self.u + st.y * self.v - origin;
        let distance = to_light.length();
        self.seen(st, to_light / distance, distance)
    }

    pub(super) fn along(&self, origin: DVec3, direction: DVec3) -> Option<Seen> {
        let distance = (self.center - origin).dot(self.normal) / direction.dot(self.normal);
        if !distance.is_finite() || distance <= 0.0 {
            return None;
        }
        let p = origin + distance * direction - self.center;
        let st = DVec2::new(p.dot(self.dual[0]), p.dot(self.dual[1]));
        self.seen(st, direction, distance)
    }

    fn seen(&self, st: DVec2, wi: DVec3, distance: f64) -> Option<Seen> {
        let cos = wi.dot(self.normal);
        if !self.contains(st) || cos == 0.0 || distance == 0.0 {
            return None;
        }
        let rectangle = 4.0 * self.u.cross(self.v).length();
        let area = match self.outline {
            Outline::Ellipse => rectangle * std::f64::consts::FRAC_PI_4,
            Outline::Parallelogram | Outline::Loops(_) => rectangle,
        };
        let uv = DVec2::from_array(self.uv.map(|row| row.dot(st.extend(1.0))));
        let pdf = distance * distance / (cos.abs() * area);
        Some(Seen { wi, distance, front: cos < 0.0, uv, pdf })
    }

    fn contains(&self, st: DVec2) -> bool {
        match &self.outline {
            Outline::Parallelogram => st.abs().max_element() <= 1.0,
            Outline::Ellipse => st.length_squared() <= 1.0,
            Outline::Loops(loops) => {
                let crossings: usize = loops.iter().map(|l| crossings(l, st)).sum();
                crossings % 2 == 1
            }
        }
    }
}

/// Edges of a closed loop that a ray from `p` along +s crosses.
fn crossings(vertices: &[DVec2], p: DVec2) -> usize {
    let next = vertices.iter().cycle().skip(1);
    let crosses = |(a, b): &(&DVec2, &DVec2)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    vertices.iter().zip(next).filter(crosses).count()
}

/// Unit normal of a loop by Newell's sum, right for concave and slightly bent ones too.
fn newell_normal(vertices: &[DVec3]) -> DVec3 {
    let next = vertices.iter().cycle().skip(1);
    let first = vertices.first().copied().unwrap_or_default();
    let area = |(a, b): (&DVec3, &DVec3)| (a - first).cross(b - first);
    vertices.iter().zip(next).map(area).sum::<DVec3>().normalize_or(DVec3::Z)
}

/// The affine map from (s, t) to texture coordinates that fits the vertices' own in the least squares; exact for a
/// picture that lies flat on the polygon.
fn affine_uv(vertices: &[DVec2], uvs: &[[f32; 2]]) -> [DVec3; 2] {
    let mut normal = DMat3::ZERO;
    let mut right = [DVec3::ZERO; 2];
    for (vertex, uv) in vertices.iter().zip(uvs) {
        let p = vertex.extend(1.0);
        normal += DMat3::from_cols(p * p.x, p * p.y, p);
        for (sum, coordinate) in right.iter_mut().zip(uv) {
            *sum += p * f64::from(*coordinate);
        }
    }
    let inverse = normal.inverse();
    right.map(|sum| inverse * sum)
}
