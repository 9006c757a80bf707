//! Rays against all triangles in double precision, with what float32 may leave open.

use amas::shared::RayProbeRow;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

/// What a ray's corners may be off by, relative to the farthest corner's distance: an edge test of float32 is off by a
/// few roundings of 6e-8.
const MARGIN: f64 = 2e-6;

/// What must be answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// No triangle comes near.
    Free,
    /// Within rounding of an edge or of an end of the ray.
    Either,
    /// A triangle is met well inside.
    Hidden,
}

/// The answer by brute force.
pub(crate) fn answer(triangles: &[[DVec3; 3]], row: &RayProbeRow) -> Answer {
    let mut best = Answer::Free;
    for triangle in triangles {
        match meets(triangle, row) {
            Answer::Hidden => return Answer::Hidden,
            Answer::Either => best = Answer::Either,
            Answer::Free => {}
        }
    }
    best
}

fn meets(triangle: &[DVec3; 3], row: &RayProbeRow) -> Answer {
    let [origin, direction] = [row.origin, row.direction].map(|v| Vec3::from(v).as_dvec3());
    let (t_min, t_max) = (f64::from(row.t_min), f64::from(row.t_max));
    // Along the ray, and across it.
    let z = direction / direction.length_squared();
    let x = direction.any_orthogonal_vector().normalize();
    let y = direction.cross(x).normalize();
    let corners = triangle.map(|corner| corner - origin);
    let reach = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let flat = corners.map(|p| DVec2::new(p.dot(x), p.dot(y)));
    let margin = MARGIN * reach;
    let [from, to] = [0, 1, 2]
        .map(|i| corners[i].dot(z))
        .into_iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], t| [least.min(t), most.max(t)]);
    let near_edge = (0..3).map(|i| distance(flat[i], flat[(i + 1) % 3])).fold(f64::INFINITY, f64::min);
    let doubled = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
    let inside = (0..3).all(|i| flat[i].perp_dot(flat[(i + 1) % 3]) * doubled > 0.0);
    if !inside && near_edge > margin {
        return Answer::Free;
    }
    if from > t_max + margin || to < t_min - margin {
        return Answer::Free;
    }
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let (height, slope) = (normal.dot(corners[0]), normal.dot(direction));
    let t = height / slope;
    // The plane's distance is as uncertain as the corners', and that counts for more where the ray grazes it.
    let blur = margin * (1.0 + normal.length() / slope.abs());
    if inside && near_edge > margin && (t < t_min - blur || t > t_max + blur || t < -blur) {
        return Answer::Free;
    }
    if inside && near_edge > margin && t > t_min + blur && t < t_max - blur && t > blur {
        return Answer::Hidden;
    }
    Answer::Either
}

/// Of the origin from a segment.
fn distance(a: DVec2, b: DVec2) -> f64 {
    let edge = b - a;
    let t = (-a.dot(edge) / edge.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + edge * t).length()
}

/// Fails where the device contradicts the exact answer; returns how many of `Free`, `Either` and `Hidden` there were.
pub(crate) fn judge(what: &str, triangles: &[[DVec3; 3]], rows: &[RayProbeRow], got: &[bool]) -> [usize; 3] {
    let answers: Vec<_> = rows.par_iter().map(|row| answer(triangles, row)).collect();
    let wrong: Vec<_> = (0..rows.len())
        .filter(|&i| matches!((answers[i], got[i]), (Answer::Free, true) | (Answer::Hidden, false)))
        .map(|i| format!("{:?}: device says {}: {:?}", answers[i], got[i], rows[i]))
        .collect();
    let count = |which| answers.iter().filter(|&&answer| answer == which).count();
    let counts = [Answer::Free, Answer::Either, Answer::Hidden].map(count);
    println!("{what}: {} rays, free, either, hidden: {counts:?}", rows.len());
    let shown = wrong[..wrong.len().min(8)].join("\n");
    assert!(wrong.is_empty(), "{what}: {} of {} rays:\n{shown}", wrong.len(), rows.len());
    counts
}
