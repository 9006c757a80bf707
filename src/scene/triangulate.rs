//! Polygons to triangles.

use glam::{DVec2, DVec3};

use super::geometry::Corner;

/// Longest loop whose ears are sought; a longer one gets a fan, since the search is quadratic.
const LONGEST: usize = 1024;

/// Triangles of the polygon, as indices into it, wound like it: a fan if it is convex, else ears.
pub(super) fn triangulate(polygon: &[Corner]) -> Vec<[usize; 3]> {
    let fan = |count: usize| (2..count).map(|i| [0, i - 1, i]).collect();
    if polygon.len() == 3 || polygon.len() > LONGEST {
        return fan(polygon.len());
    }
    let flat = flatten(polygon);
    let convex = |i: usize| turn(flat[i], flat[(i + 1) % flat.len()], flat[(i + 2) % flat.len()]) >= 0.0;
    if (0..flat.len()).all(convex) { fan(polygon.len()) } else { ears(&flat) }
}

/// The polygon in its plane, counter-clockwise.
fn flatten(polygon: &[Corner]) -> Vec<DVec2> {
    let origin = polygon[0].position.as_dvec3();
    let points: Vec<DVec3> = polygon.iter().map(|corner| corner.position.as_dvec3() - origin).collect();
    let normal: DVec3 = points.windows(2).map(|edge| edge[0].cross(edge[1])).sum();
    let normal = normal.normalize_or(DVec3::Z);
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    points.iter().map(|p| DVec2::new(p.dot(u), p.dot(v))).collect()
}

fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - b)
}

/// Ear clipping of a counter-clockwise loop; where no ear is left (a loop that crosses itself) the first corner is cut all the same.
pub(super) fn ears(flat: &[DVec2]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut triangles = Vec::with_capacity(flat.len() - 2);
    while left.len() > 3 {
        let count = left.len();
        let ear = (0..count).find(|i| is_ear(flat, &left, *i)).unwrap_or(0);
        triangles.push([left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]]);
        left.remove(ear);
    }
    triangles.push([left[0], left[1], left[2]]);
    triangles
}

fn is_ear(flat: &[DVec2], left: &[usize], i: usize) -> bool {
    let count = left.len();
    let corners = [left[(i + count - 1) % count], left[i], left[(i + 1) % count]];
    let [a, b, c] = corners.map(|index| flat[index]);
    let covers = |p: DVec2| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let other = |index: &&usize| !corners.contains(index) && ![a, b, c].contains(&flat[**index]);
    turn(a, b, c) > 0.0 && !left.iter().filter(other).any(|index| covers(flat[*index]))
}
