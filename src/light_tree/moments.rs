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
use glam::DVec3;
use rayon::prelude::*;
use sums::Sums;

/// Lights of a leaf.
const LEAF: usize = MOMENT_LEAF as usize;
/// Children of an inner node.
const FAN: usize = 8;

/// Up to so many lights without a range every pixel evaluates them all: cut and lists cost more than they save.
pub const LIGHTS_WITHOUT_CUT: usize = 256;

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
    let shift = sums.shifts();
    let of_axis = |axis: usize| shift.map(|shift: DVec3| shift[axis] as f32);
    let [kink, skew] = sums.errors(radius);
    let [shift_zr, shift_zg, shift_zb] = of_axis(2);
    MomentNode {
        center: center.to_array(),
        skip: 0,
        power: sums.power() as f32,
        radius: radius as f32,
        kink: kink as f32,
        skew: skew as f32,
        diagonal: diagonal.as_vec3().to_array(),
        first,
        mixed: mixed.as_vec3().to_array(),
        shift_zr,
        intensity: sums.intensity.map(|intensity| intensity as f32),
        shift_zg,
        shift_x: of_axis(0),
        shift_zb,
        shift_y: of_axis(1),
        trace: diagonal.element_sum() as f32,
    }
}
