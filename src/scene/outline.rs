//! Checks of planar outlines: what makes a polygon light's loops usable.

use glam::{DVec2, DVec3};

/// The remedy of every error of this module.
pub(super) const REMEDY: &str =
    "give distinct vertices of one plane, in order around a simple outline; holes lie inside it";

/// Distance from the plane, as a share of the extent, that still counts as planar.
const FLATNESS: f64 = 1e-4;

/// The plane of an outer loop.
pub(super) struct Plane {
    origin: DVec3,
    normal: DVec3,
    u: DVec3,
    /// Longest side of the outer loop's bounding box.
    extent: f64,
}

impl Plane {
    /// The plane through `outer`, whose normal is its Newell normal, or the reason why the loop is unusable.
    pub(super) fn new(outer: &[DVec3]) -> Result<Self, String> {
        let (low, high) =
            outer.iter().fold((outer[0], outer[0]), |(low, high), p| (low.min(*p), high.max(*p)));
        let extent = (high - low).max_element();
        let origin = outer.iter().sum::<DVec3>() / outer.len() as f64;
        let normal: DVec3 = edges(outer).map(|(a, b)| (a - origin).cross(b - origin)).sum();
        // Coordinates end as float32, so an area below their resolution is none.
        if extent <= 1e-6 * high.abs().max(low.abs()).max_element()
            || normal.length() <= 1e-9 * extent * extent
        {
            return Err("encloses no area, or crosses itself into parts that cancel".to_owned());
        }
        let normal = normal.normalize();
        let plane = Self { origin, normal, u: normal.any_orthonormal_vector(), extent };
        plane.check_loop(outer)?;
        Ok(plane)
    }

    /// Whether `hole` lies in the plane and within `outer`.
    pub(super) fn check_hole(&self, outer: &[DVec3], hole: &[DVec3]) -> Result<(), String> {
        self.check_loop(hole)?;
        self.check_apart(outer, hole)?;
        let outer = self.flatten(outer);
        let inside = |point: &DVec2| {
            let near = |(a, b): (DVec2, DVec2)| distance(*point, a, b) <= FLATNESS * self.extent;
            edges(&outer).any(near) || encloses(&outer, *point)
        };
        match self.flatten(hole).iter().position(|point| !inside(point)) {
            Some(index) => Err(format!("leaves the outer loop at its vertex {index}")),
            None => Ok(()),
        }
    }

    /// Whether the edges of two loops keep clear of one another.
    pub(super) fn check_apart(&self, one: &[DVec3], other: &[DVec3]) -> Result<(), String> {
        let (one, other) = (self.flatten(one), self.flatten(other));
        let hit = |edge: &(DVec2, DVec2)| edges(&other).any(|second| cross(*edge, second));
        match edges(&one).position(|edge| hit(&edge)) {
            Some(index) => Err(format!("crosses edge {index} of another loop")),
            None => Ok(()),
        }
    }

    fn check_loop(&self, points: &[DVec3]) -> Result<(), String> {
        for (index, point) in points.iter().enumerate() {
            let off = (*point - self.origin).dot(self.normal).abs();
            if off > FLATNESS * self.extent {
                return Err(format!(
                    "is not planar: vertex {index} is {off:.3e} m off the plane of the outer loop"
                ));
            }
        }
        let flat = self.flatten(points);
        if let Some(index) = edges(points).position(|(a, b)| a.as_vec3() == b.as_vec3()) {
            return Err(format!("has vertex {index} twice in a row"));
        }
        match crossing(&flat) {
            Some((a, b)) => Err(format!("crosses itself: edges {a} and {b}")),
            None => Ok(()),
        }
    }

    fn flatten(&self, points: &[DVec3]) -> Vec<DVec2> {
        let v = self.normal.cross(self.u);
        let flat =
            |point: &DVec3| DVec2::new((*point - self.origin).dot(self.u), (*point - self.origin).dot(v));
        points.iter().map(flat).collect()
    }
}

/// The edges of a closed loop.
fn edges<T: Copy>(points: &[T]) -> impl Iterator<Item = (T, T)> + '_ {
    points.iter().copied().zip(points.iter().copied().cycle().skip(1))
}

/// Two edges that properly cross, if any do.
fn crossing(points: &[DVec2]) -> Option<(usize, usize)> {
    let edges: Vec<(DVec2, DVec2)> = edges(points).collect();
    let pairs = (0..edges.len()).flat_map(|i| (i + 2..edges.len()).map(move |j| (i, j)));
    pairs.into_iter().find(|(i, j)| cross(edges[*i], edges[*j]))
}

/// Whether two segments properly cross: touching does not count.
fn cross((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Sign of the side of a→b on which `p` lies.
fn side(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let area = (b - a).perp_dot(p - a);
    if area == 0.0 { 0.0 } else { area.signum() }
}

/// Distance of `p` from the segment a→b.
fn distance(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let edge = b - a;
    let t = ((p - a).dot(edge) / edge.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    p.distance(a + edge * t)
}

/// Even-odd rule.
fn encloses(points: &[DVec2], p: DVec2) -> bool {
    let crossed = |(a, b): &(DVec2, DVec2)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    edges(points).filter(crossed).count() % 2 == 1
}
