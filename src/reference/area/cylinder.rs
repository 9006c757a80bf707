//! Line lights: a diffuse cylinder without caps, emitting outwards.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::Seen;

#[derive(Clone, Copy, Debug)]
pub(super) struct Cylinder {
    start: DVec3,
    /// Unit.
    axis: DVec3,
    length: f64,
    radius: f64,
}

impl Cylinder {
    pub(super) fn new(a: DVec3, b: DVec3, radius: f64) -> Self {
        Self { start: a, axis: (b - a).normalize_or_zero(), length: (b - a).length(), radius }
    }

    /// Height of the highest point above the plane through `origin` with the unit normal, or more.
    pub(super) fn highest(&self, origin: DVec3, normal: DVec3) -> f64 {
        let start = (self.start - origin).dot(normal);
        start.max(start + self.length * self.axis.dot(normal)) + self.radius
    }

    /// Centre, squared radius and area.
    pub(super) fn extent(&self) -> (DVec3, f64, f64) {
        let half = 0.5 * self.length;
        let size2 = half * half + self.radius * self.radius;
        (self.start + half * self.axis, size2, 2.0 * PI * self.radius * self.length)
    }

    /// A point of the side that is turned to `origin`; none from inside.
    pub(super) fn sample(&self, origin: DVec3, xi: DVec2) -> Option<Seen> {
        let out = self.perpendicular(origin - self.start);
        let distance_to_axis = out.length();
        if distance_to_axis <= self.radius {
            return None;
        }
        let half_arc = (self.radius / distance_to_axis).acos();
        let (sin, cos) = ((2.0 * xi.x - 1.0) * half_arc).sin_cos();
        let out = out / distance_to_axis;
        let normal = cos * out + sin * self.axis.cross(out);
        let p = self.start + xi.y * self.length * self.axis + self.radius * normal;
        let to_light = p - origin;
        let distance = to_light.length();
        self.seen(normal, to_light / distance, distance, distance_to_axis, xi.y)
    }

    pub(super) fn along(&self, origin: DVec3, direction: DVec3) -> Option<Seen> {
        let offset = origin - self.start;
        let (out, across) = (self.perpendicular(offset), self.perpendicular(direction));
        let a = across.length_squared();
        let b = out.dot(across);
        // b² − a(|out|² − r²), by Lagrange's identity without the cancellation of a thin and far cylinder.
        let discriminant = a * self.radius * self.radius - out.cross(across).length_squared();
        let distance_to_axis = out.length();
        if a == 0.0 || discriminant <= 0.0 || distance_to_axis <= self.radius {
            return None;
        }
        let distance = (-b - discriminant.sqrt()) / a;
        let along = (offset + distance * direction).dot(self.axis) / self.length;
        if distance <= 0.0 || !(0.0..=1.0).contains(&along) {
            return None;
        }
        let normal = (out + distance * across) / self.radius;
        self.seen(normal, direction, distance, distance_to_axis, along)
    }

    fn perpendicular(&self, v: DVec3) -> DVec3 {
        v - self.axis * v.dot(self.axis)
    }

    fn seen(
        &self,
        normal: DVec3,
        wi: DVec3,
        distance: f64,
        distance_to_axis: f64,
        along: f64,
    ) -> Option<Seen> {
        let cos = -wi.dot(normal);
        if cos <= 0.0 {
            return None;
        }
        let area = 2.0 * (self.radius / distance_to_axis).acos() * self.radius * self.length;
        let around = 0.5 + normal.y.atan2(normal.x) / (2.0 * PI);
        let pdf = distance * distance / (cos * area);
        Some(Seen { wi, distance, front: true, uv: DVec2::new(along, around), pdf })
    }
}
