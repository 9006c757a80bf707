//! The tree over lights without a range: each node knows its lights' summed intensity, centroid and second moments, so
//! that from afar it stands for all of them, and how far off it is.
//!
//! 1. Every 8 lights along the curve make a leaf, every 8 nodes a parent; `sums.rs` adds their moments up.
//! 2. Nodes lie in depth-first order, each with the index of the node that follows where it is not opened; a leaf's
//!    is its own index plus one.
//! 3. One null node lies behind them: the padding of lists.

mod sums;

use crate::scene::PointLight;
use crate::shared::{MOMENT_LEAF, MomentNode};
use rayon::prelude::*;
use sums::Sums;

/// Lights of a leaf.
const LEAF: usize = MOMENT_LEAF as usize;
/// Children of an inner node.
const FAN: usize = 8;

/// Up to so many lights without a range every pixel evaluates them all: cut and lists cost more than they save.
pub const LIGHTS_WITHOUT_CUT: usize = 512;

/// Nodes over `lights`, the first of which has index `first` among all lights.
#[must_use]
pub fn build(lights: &[PointLight], first: usize) -> Vec<MomentNode> {
    let mut levels: Vec<Vec<Sums>> = vec![lights.par_chunks(LEAF).map(Sums::of_lights).collect()];
    while levels[levels.len() - 1].len() > 1 {
        let below = &levels[levels.len() - 1];
        levels.push(below.par_chunks(FAN).map(Sums::of_parts).collect());
    }
    let mut nodes = Vec::new();
    let tree = Tree { lights, first, levels };
    tree.emit(tree.levels.len() - 1, 0, &mut nodes);
    let skip = nodes.len() as u32 + 1;
    nodes.push(MomentNode { skip, ..MomentNode::default() });
    nodes
}

struct Tree<'a> {
    lights: &'a [PointLight],
    first: usize,
    // From the leaves up.
    levels: Vec<Vec<Sums>>,
}

impl Tree<'_> {
    /// Appends the subtree under node `place` of a level.
    fn emit(&self, level: usize, place: usize, nodes: &mut Vec<MomentNode>) {
        let span = LEAF * FAN.pow(level as u32);
        let begin = place * span;
        let lights = &self.lights[begin..self.lights.len().min(begin + span)];
        let index = nodes.len();
        nodes.push(node(&self.levels[level][place], lights, (self.first + begin) as u32));
        if level > 0 {
            let children = self.levels[level - 1].len().min((place + 1) * FAN);
            (place * FAN..children).for_each(|child| self.emit(level - 1, child, nodes));
        }
        nodes[index].skip = nodes.len() as u32;
    }
}

fn node(sums: &Sums, lights: &[PointLight], first: u32) -> MomentNode {
    let center = sums.center.as_vec3();
    // What float32 may lose of a position included, so that no light lies outside.
    let farthest = lights.iter().map(|light| light.position.as_dvec3().distance_squared(center.as_dvec3()));
    let radius = farthest.fold(0.0, f64::max).sqrt() * (1.0 + 1e-6);
    let [diagonal, mixed] = sums.covariance();
    let shifts = sums.shifts().map(|shift| if radius > 0.0 { shift / radius } else { shift });
    let extents = |axis: usize| {
        let places = lights.iter().map(|light| f64::from(light.position[axis]) - f64::from(center[axis]));
        let (below, above) =
            places.fold((0.0, 0.0), |(below, above), at| (f64::max(below, -at), f64::max(above, at)));
        fractions([below, above].map(|extent| if radius > 0.0 { extent / radius } else { 0.0 }))
    };
    MomentNode {
        center: center.to_array(),
        radius: radius as f32,
        power: sums.power() as f32,
        error: sums.error(radius) as f32,
        skip: 0,
        first,
        diagonal: diagonal.as_vec3().to_array(),
        shift_x: tens(shifts.map(|shift| shift.x)),
        mixed: mixed.as_vec3().to_array(),
        shift_y: tens(shifts.map(|shift| shift.y)),
        intensity: sums.intensity.map(|intensity| intensity as f32),
        shift_z: tens(shifts.map(|shift| shift.z)),
        extent_x: extents(0),
        extent_y: extents(1),
        extent_z: extents(2),
        count: lights.len() as u32,
    }
}

/// Two numbers in [0, 1] as 16 bits each, rounded up.
fn fractions(values: [f64; 2]) -> u32 {
    let bits = values.map(|value| (value.min(1.0) * 65535.0).ceil() as u32);
    bits[0] | bits[1] << 16
}

/// Three numbers in [−1, 1] as 10 bits each.
fn tens(values: [f64; 3]) -> u32 {
    let bits = values.map(|value| (value.clamp(-1.0, 1.0) * 511.0).round() as i32 as u32 & 1023);
    bits[0] | bits[1] << 10 | bits[2] << 20
}

#[cfg(test)]
mod tests;
