//! What stands between a light and a surface, in double precision.
//!
//! Every triangle that no mask cuts is in the way, from either side and whether or not that side is drawn, and so is
//! every area light that is seen (`visible`), as the exact shape and from its back as well. A shadow ray leaves from the
//! point itself, not from beside it: it does not meet the triangle that the point lies in, and both of its ends are
//! shorter by 1e-9 of the distances in play, far less than what float32 vertices can tell apart. What coincides with
//! the surface or with the light then hides neither, and nothing leaks where two walls touch.

use glam::DVec3;

use super::area::Emitter;
use super::rays::{Geometry, Hit, Ray};

/// What a shadow ray leaves out at each end, relative to the coordinates and distances in play, whose rounding is 1e-16.
pub(crate) const MARGIN: f64 = 1e-9;

/// Everything that can be in the way.
#[derive(Debug)]
pub struct Occluders<'a> {
    /// Triangles.
    pub geometry: &'a Geometry<'a>,
    /// Area lights, of which those that are seen occlude.
    pub emitters: &'a [Emitter<'a>],
}

/// The view from a point of a surface towards the lights.
#[derive(Debug)]
pub struct Shadow<'a> {
    occluders: &'a Occluders<'a>,
    position: DVec3,
    /// Mesh and triangle of the point.
    triangle: (usize, usize),
    /// The triangle's normal on the viewer's side, of any length.
    normal: DVec3,
    /// Largest number that went into the position.
    scale: f64,
}

/// What lies along a ray from a surface.
#[derive(Debug)]
pub(super) struct Prospect {
    /// From the surface.
    pub(super) ray: Ray,
    /// Distances between which lights are seen.
    pub(super) range: [f64; 2],
    /// The luminaire at the end of the range, if it is one.
    pub(super) luminaire: Option<usize>,
    /// The triangle at the end of the range, if it is one.
    pub(super) wall: Option<Hit>,
}

impl<'a> Shadow<'a> {
    /// From where `ray` hit.
    #[must_use]
    pub fn new(occluders: &'a Occluders<'a>, ray: &Ray, hit: &Hit) -> Self {
        let position = ray.origin + hit.t * ray.direction;
        let normal = occluders.geometry.normal(hit);
        Self {
            occluders,
            position,
            triangle: (hit.mesh, hit.triangle),
            normal: if normal.dot(ray.direction) > 0.0 { -normal } else { normal },
            scale: position.abs().max_element().max(ray.origin.abs().max_element()).max(hit.t),
        }
    }

    /// What is seen along the unit vector `wi`; `None` where the point's own triangle hides it.
    pub(super) fn prospect(&self, wi: DVec3) -> Option<Prospect> {
        if self.normal.dot(wi) <= 0.0 {
            return None;
        }
        let ray = Ray::new(self.position, wi);
        let t_min = MARGIN * self.scale;
        let wall = self.occluders.geometry.wall(&ray, t_min, self.triangle);
        let mut end = wall.map_or(f64::INFINITY, |hit| hit.t);
        let mut luminaire = None;
        for (index, emitter) in self.occluders.emitters.iter().enumerate() {
            if let Some(t) = emitter.occluder(&ray).filter(|t| (t_min..end).contains(t)) {
                (end, luminaire) = (t, Some(index));
            }
        }
        let wall = wall.filter(|_| luminaire.is_none());
        Some(Prospect { ray, range: [t_min, end], luminaire, wall })
    }

    /// Whether what shines from `distance` along the unit vector `wi` is hidden. The emitter with the index `own` does
    /// not hide a point of its own.
    ///
    /// The triangle of the point itself hides what is behind it, as the viewer sees it, even where an interpolated or
    /// mapped normal leans that way.
    #[must_use]
    pub fn covers(&self, wi: DVec3, distance: f64, own: Option<usize>) -> bool {
        if self.normal.dot(wi) <= 0.0 {
            return true;
        }
        let ray = Ray::new(self.position, wi);
        let margin = MARGIN * self.scale.max(distance);
        let range = [margin, distance - margin];
        let others = (0..).zip(self.occluders.emitters).filter(|(index, _)| Some(*index) != own);
        let mut distances = others.filter_map(|(_, emitter)| emitter.occluder(&ray));
        distances.any(|t| (range[0]..range[1]).contains(&t))
            || self.occluders.geometry.occludes(&ray, range, Some(self.triangle))
    }
}
