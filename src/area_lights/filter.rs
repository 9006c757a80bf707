//! Textures of lights, averaged over what each point of cubature stands for.

use super::cubature::{Cell, Node};
use super::plane::Plane;
use crate::scene::mips::Level;
use glam::{DVec2, DVec3};

/// Samples across the light; those of a cell are its share of them.
const ACROSS: f64 = 128.0;

/// Mean texel over each node's cell, in the nodes' order; weighted by the shares they add up to the light's mean.
pub(super) fn means(plane: &Plane, triangles: &[[DVec2; 3]], nodes: &[Node], levels: &[Level]) -> Vec<DVec3> {
    let level = level_for(plane, levels);
    let texel = |st: DVec2| sample(level, plane.uv_at(st));
    if nodes.iter().all(|node| matches!(node.cell, Cell::Nearest)) {
        return nearest(plane, triangles, nodes, texel);
    }
    let count = (ACROSS / (nodes.len() as f64).sqrt()).ceil() as u32;
    let mean = |node: &Node| {
        let ([low, high], to_st): ([DVec2; 2], fn(DVec2) -> DVec2) = match node.cell {
            Cell::Rectangle(corners) => (corners, |p| p),
            Cell::Sector(corners) => (corners, |p| p.x.sqrt() * DVec2::from_angle(p.y)),
            Cell::Nearest => ([node.st; 2], |p| p),
        };
        let place = |i: u32| (f64::from(i) + 0.5) / f64::from(count);
        let at = |x: u32, y: u32| to_st(low + (high - low) * DVec2::new(place(x), place(y)));
        let sum: DVec3 = (0..count).flat_map(|y| (0..count).map(move |x| texel(at(x, y)))).sum();
        sum / f64::from(count * count)
    };
    nodes.iter().map(mean).collect()
}

/// Cells of the nearest points, whose means are then scaled so that the light's own is kept.
fn nearest(
    plane: &Plane,
    triangles: &[[DVec2; 3]],
    nodes: &[Node],
    texel: impl Fn(DVec2) -> DVec3,
) -> Vec<DVec3> {
    let metric = DVec2::new(plane.u.length(), plane.v.length());
    let steps = (ACROSS / (triangles.len() as f64).sqrt()).clamp(4.0, ACROSS) as u32;
    let mut sums = vec![(DVec3::ZERO, 0.0); nodes.len()];
    for triangle in triangles {
        let weight = super::plane::area(triangle) / f64::from(steps * steps);
        for st in centroids(triangle, steps) {
            let distance = |node: &Node| ((node.st - st) * metric).length_squared();
            let near = (0..nodes.len()).min_by(|&a, &b| distance(&nodes[a]).total_cmp(&distance(&nodes[b])));
            if let Some(near) = near {
                sums[near].0 += weight * texel(st);
                sums[near].1 += weight;
            }
        }
    }
    let (all, area) = sums.iter().fold((DVec3::ZERO, 0.0), |(a, b), (c, d)| (a + c, b + d));
    let whole = all / area;
    let own = |((sum, weight), node): (&(DVec3, f64), &Node)| {
        if *weight > 0.0 { *sum / *weight } else { texel(node.st) }
    };
    let means: Vec<_> = sums.iter().zip(nodes).map(own).collect();
    let total: DVec3 = means.iter().zip(nodes).map(|(mean, node)| mean * node.share).sum();
    let scale = DVec3::select(total.cmpgt(DVec3::ZERO), whole / total, DVec3::ONE);
    means.into_iter().map(|mean| mean * scale).collect()
}

/// Centroids of the steps² equal triangles into which a triangle falls.
fn centroids([a, b, c]: &[DVec2; 3], steps: u32) -> impl Iterator<Item = DVec2> {
    let (a, x, y) = (*a, (b - a) / f64::from(steps), (c - a) / f64::from(steps));
    let up = move |i: u32, j: u32| a + x * (f64::from(i) + 1.0 / 3.0) + y * (f64::from(j) + 1.0 / 3.0);
    let down = move |i: u32, j: u32| a + x * (f64::from(i) + 2.0 / 3.0) + y * (f64::from(j) + 2.0 / 3.0);
    (0..steps).flat_map(move |j| {
        let row = steps - j;
        (0..row).map(move |i| up(i, j)).chain((0..row - 1).map(move |i| down(i, j)))
    })
}

/// The first level with no more texels across the light than there are samples.
fn level_for<'a>(plane: &Plane, levels: &'a [Level]) -> &'a Level {
    let size = DVec2::from_array(levels[0].size.map(|side| side as f64));
    let along = |axis: usize| 2.0 * (DVec2::new(plane.uv[0][axis], plane.uv[1][axis]) * size).length();
    let texels = along(0).max(along(1));
    let level = (texels / ACROSS).log2().ceil().clamp(0.0, (levels.len() - 1) as f64);
    &levels[level as usize]
}

/// Bilinear and clamped, (0, 0) at the lower left.
fn sample(level: &Level, uv: DVec2) -> DVec3 {
    let size = DVec2::from_array(level.size.map(|side| side as f64));
    let at = DVec2::new(uv.x, 1.0 - uv.y) * size - 0.5;
    let (corner, s) = (at.floor(), at - at.floor());
    let fetch = |dx: f64, dy: f64| {
        let [x, y] = [corner.x + dx, corner.y + dy];
        let (x, y) = (x.clamp(0.0, size.x - 1.0) as usize, y.clamp(0.0, size.y - 1.0) as usize);
        let [r, g, b, _] = level.texels[y * level.size[0] + x];
        DVec3::new(r.into(), g.into(), b.into())
    };
    fetch(0.0, 0.0).lerp(fetch(1.0, 0.0), s.x).lerp(fetch(0.0, 1.0).lerp(fetch(1.0, 1.0), s.x), s.y)
}
