//! A polygon with holes as one loop: bridges from hole to outline, run along in both directions.

use glam::{DVec2, DVec3};

/// Unit normal of a loop by Newell's sum.
pub(super) fn newell_normal(vertices: &[DVec3]) -> DVec3 {
    let first = vertices.first().copied().unwrap_or_default();
    let next = vertices.iter().cycle().skip(1);
    let area = |(a, b): (&DVec3, &DVec3)| (a - first).cross(b - first);
    vertices.iter().zip(next).map(area).sum::<DVec3>().normalize_or(DVec3::Z)
}

/// The counter-clockwise loop `outline` with every hole joined to it, as indices into `places`. Holes may wind either
/// way; one that no straight bridge reaches is joined to the nearest corner all the same.
pub(super) fn bridged(places: &[DVec2], mut outline: Vec<usize>, mut holes: Vec<Vec<usize>>) -> Vec<usize> {
    for hole in &mut holes {
        if area(places, hole) > 0.0 {
            hole.reverse();
        }
    }
    // From the right: no other hole can lie between the rightmost corner of all and everything beyond it.
    let rightmost = |hole: &[usize]| {
        let mut corners = hole.iter().copied().enumerate();
        let first = corners.next().unwrap_or_default();
        corners.fold(first, |most, corner| if places[corner.1].x > places[most.1].x { corner } else { most })
    };
    holes.sort_by(|a, b| places[rightmost(a).1].x.total_cmp(&places[rightmost(b).1].x));
    while let Some(hole) = holes.last() {
        let (start, _) = rightmost(hole);
        let at = nearest(places, &outline, &holes, start);
        let around = hole.iter().cycle().skip(start).take(hole.len() + 1).copied();
        let bridge: Vec<_> = around.chain([outline[at]]).collect();
        outline.splice(at + 1..at + 1, bridge);
        holes.pop();
    }
    outline
}

fn area(places: &[DVec2], indices: &[usize]) -> f64 {
    edges(indices).map(|[a, b]| places[a].perp_dot(places[b])).sum()
}

fn edges(indices: &[usize]) -> impl Iterator<Item = [usize; 2]> + '_ {
    indices.iter().copied().zip(indices.iter().copied().cycle().skip(1)).map(|(a, b)| [a, b])
}

/// The position in the outline that the shortest free bridge joins with corner `start` of the last hole.
fn nearest(places: &[DVec2], outline: &[usize], holes: &[Vec<usize>], start: usize) -> usize {
    let hole = holes.last().map_or(outline, Vec::as_slice);
    let from = places[hole[start]];
    let mut order: Vec<_> = (0..outline.len()).collect();
    let distance = |at: usize| places[outline[at]].distance_squared(from);
    order.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    let walls: Vec<_> =
        std::iter::once(outline).chain(holes.iter().map(Vec::as_slice)).flat_map(edges).collect();
    let free = |&&at: &&usize| {
        let to = places[outline[at]];
        let blocked = walls.iter().any(|&[a, b]| blocks([places[a], places[b]], [from, to]));
        !blocked && inside(places, outline, at, from) && inside(places, hole, start, to)
    };
    order.iter().find(free).copied().unwrap_or(order[0])
}

/// Whether a wall properly crosses a bridge, or begins on it.
fn blocks([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let side = |a: DVec2, b: DVec2, p: DVec2| (b - a).perp_dot(p - a);
    let begins = side(c, d, a) == 0.0 && (a - c).dot(d - c) > 0.0 && (a - d).dot(c - d) > 0.0;
    begins || side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Whether `p` lies within the angle of the loop's corner `at`: corners that lie on one another differ in that.
fn inside(places: &[DVec2], outline: &[usize], at: usize, p: DVec2) -> bool {
    let count = outline.len();
    let [before, corner, after] = [at + count - 1, at, at + 1].map(|i| places[outline[i % count]]);
    let left_of = |a: DVec2, b: DVec2| (b - a).perp_dot(p - a) > 0.0;
    if (corner - before).perp_dot(after - corner) > 0.0 {
        left_of(before, corner) && left_of(corner, after)
    } else {
        left_of(before, corner) || left_of(corner, after)
    }
}
