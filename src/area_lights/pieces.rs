//! Outlines with holes as convex pieces.

use super::plane::{Outline, Plane, area};
use crate::scene::{AreaLight, Luminaire};
use glam::DVec2;
use std::collections::HashMap;

/// Vertices of a piece at most.
const LONGEST: usize = 8;
/// Sine of the angle by which a corner may turn inwards, for rounding.
const FLAT: f64 = 1e-9;

/// Counter-clockwise convex pieces of at most 8 vertices that tile the outline, in (s, t): ears, merged across their
/// diagonals as long as what results is convex (Hertel and Mehlhorn 1983). None of an ellipse.
pub(super) fn pieces(plane: &Plane, light: &AreaLight) -> Vec<Vec<DVec2>> {
    let rings = plane.rings();
    let places: Vec<DVec2> = match &plane.outline {
        Outline::Ellipse => return Vec::new(),
        Outline::Parallelogram => return rings,
        // As the luminaire has them: the outline, then its holes as they were given.
        Outline::Loops(_) => flattened(plane, light),
    };
    if let [outline] = rings.as_slice()
        && outline.len() <= LONGEST
        && is_convex(outline)
    {
        return rings;
    }
    let triangles = Luminaire::new(light).triangles.into_iter().map(|t| t.map(|i| i as usize));
    let solid = |t: &[usize; 3]| area(&t.map(|i| places[i])) > 1e-14;
    let merged = merge(&places, &triangles.filter(solid).collect::<Vec<_>>());
    merged.into_iter().map(|piece| piece.into_iter().map(|i| places[i]).collect()).collect()
}

/// Triangles of the pieces.
pub(super) fn triangles(pieces: &[Vec<DVec2>]) -> Vec<[DVec2; 3]> {
    let fan =
        |piece: &Vec<DVec2>| (2..piece.len()).map(|i| [piece[0], piece[i - 1], piece[i]]).collect::<Vec<_>>();
    pieces.iter().flat_map(fan).collect()
}

fn flattened(plane: &Plane, light: &AreaLight) -> Vec<DVec2> {
    let (u, v) = (plane.u / plane.u.length_squared(), plane.v / plane.v.length_squared());
    let flat = |vertex: &crate::scene::Vertex| {
        let p = glam::Vec3::from(vertex.position).as_dvec3() - plane.center;
        DVec2::new(p.dot(u), p.dot(v))
    };
    Luminaire::new(light).vertices.iter().map(flat).collect()
}

fn is_convex(points: &[DVec2]) -> bool {
    let count = points.len();
    (0..count).all(|i| {
        let [a, b, c] = [i, i + 1, i + 2].map(|k| points[k % count]);
        let (before, after) = (b - a, c - b);
        before.perp_dot(after) >= -FLAT * before.length() * after.length()
            && (before.dot(after) > 0.0 || before.perp_dot(after) > 0.0)
    })
}

fn merge(places: &[DVec2], triangles: &[[usize; 3]]) -> Vec<Vec<usize>> {
    let mut pieces: Vec<Vec<usize>> = triangles.iter().map(|triangle| triangle.to_vec()).collect();
    let mut owner: HashMap<[usize; 2], usize> = HashMap::new();
    for (index, [a, b, c]) in triangles.iter().copied().enumerate() {
        owner.extend([[a, b], [b, c], [c, a]].map(|edge| (edge, index)));
    }
    for [a, b, c] in triangles.iter().copied() {
        for edge in [[a, b], [b, c], [c, a]] {
            let (Some(&one), Some(&other)) = (owner.get(&edge), owner.get(&[edge[1], edge[0]])) else {
                continue;
            };
            let joined = (one != other).then(|| join(&pieces[one], &pieces[other], edge)).flatten();
            let Some(joined) =
                joined.filter(|piece| is_convex(&piece.iter().map(|&i| places[i]).collect::<Vec<_>>()))
            else {
                continue;
            };
            owner.remove(&edge);
            owner.remove(&[edge[1], edge[0]]);
            for i in 0..joined.len() {
                owner.insert([joined[i], joined[(i + 1) % joined.len()]], one);
            }
            pieces[one] = joined;
            pieces[other].clear();
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// One loop of two that share the edge a → b of the first, unless it is too long.
fn join(one: &[usize], other: &[usize], [a, b]: [usize; 2]) -> Option<Vec<usize>> {
    let from = |piece: &[usize], start: usize| -> Option<Vec<usize>> {
        let at = piece.iter().position(|&index| index == start)?;
        Some(piece.iter().cycle().skip(at).take(piece.len()).copied().collect())
    };
    // b … a, and then a … b without both.
    let (mut joined, rest) = (from(one, b)?, from(other, a)?);
    let fits = joined.len() + rest.len() - 2 <= LONGEST;
    joined.extend(&rest[1..rest.len() - 1]);
    (fits && joined.last() != Some(&b)).then_some(joined)
}
