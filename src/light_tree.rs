//! Point lights in the order the device wants them, and the tree over that order.
//!
//! 1. Lights with a range come first, then those without; each kind along a Hilbert curve through its bounds.
//! 2. Every 32 lights with a range make a leaf, every 64 leaves a top node; a node's box holds its lights' spheres.
//! 3. Top nodes come first, then 64 leaves for each: a vector of invocations tests as many at once, so neither stack nor
//!    pointers. Two levels suffice: a million lights have 512 top nodes, 3 µs a parent on lavapipe.
//! 4. Many lights without a range get a tree of their own, by [`moments`].

pub mod moments;

use crate::hilbert;
use crate::scene::PointLight;
use crate::shared::{LEAF_LIGHTS, LightNode, MomentNode, TOP_LEAVES};
use glam::Vec3;
use moments::LIGHTS_WITHOUT_CUT;
use rayon::prelude::*;

/// Lights of a leaf.
const LEAF: usize = LEAF_LIGHTS as usize;
/// Leaves of a top node.
const FAN: usize = TOP_LEAVES as usize;

/// Lights in device order, and their tree.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    /// Lights, those with a range first.
    pub lights: Vec<PointLight>,
    /// How many have a range.
    pub ranged: usize,
    /// Nodes over the lights with a range: the top ones, then `TOP_LEAVES` for each.
    pub nodes: Vec<LightNode>,
    /// Nodes over the lights without a range, in depth-first order, with a null node behind them; empty where the lights
    /// are few.
    pub moments: Vec<MomentNode>,
}

impl LightTree {
    /// Orders the lights and builds the tree.
    #[must_use]
    pub fn new(lights: &[PointLight]) -> Self {
        let mut ordered = Vec::with_capacity(lights.len());
        append_along_curve(lights, true, &mut ordered);
        let ranged = ordered.len();
        let nodes = build(&ordered);
        append_along_curve(lights, false, &mut ordered);
        let unranged = &ordered[ranged..];
        let moments =
            if unranged.len() > LIGHTS_WITHOUT_CUT { moments::build(unranged, ranged) } else { vec![] };
        Self { lights: ordered, ranged, nodes, moments }
    }

    /// Top nodes.
    #[must_use]
    pub fn top_nodes(&self) -> u32 {
        (self.nodes.len() / (1 + FAN)) as u32
    }
}

/// Median of the lights' ranges, metres; 0 without any.
#[must_use]
pub fn median_range(lights: &[PointLight]) -> f32 {
    let mut ranges: Vec<f32> = lights.iter().filter_map(|light| light.range).collect();
    let middle = ranges.len() / 2;
    if ranges.is_empty() { 0.0 } else { *ranges.select_nth_unstable_by(middle, f32::total_cmp).1 }
}

/// Appends those lights that have a range, or those that have none, in their curve's order.
fn append_along_curve(lights: &[PointLight], ranged: bool, ordered: &mut Vec<PointLight>) {
    let of_kind = |light: &PointLight| light.range.is_some() == ranged;
    let count = lights.iter().filter(|light| of_kind(light)).count();
    if count == lights.len() {
        let order = hilbert::order(count, |index| lights[index].position);
        ordered.extend(order.into_iter().map(|index| lights[index as usize]));
    } else if count > 0 {
        let kind: Vec<_> = lights.iter().copied().filter(of_kind).collect();
        append_along_curve(&kind, ranged, ordered);
    }
}

fn build(lights: &[PointLight]) -> Vec<LightNode> {
    let leaf = |(i, part): (usize, &[PointLight])| {
        let (lower, upper) = bounds(part);
        let (first, count) = ((i * LEAF) as u32, part.len() as u32);
        LightNode { lower: lower.to_array(), first, upper: upper.to_array(), count }
    };
    let leaves: Vec<LightNode> = lights.par_chunks(LEAF).enumerate().map(leaf).collect();
    let top = |below: &[LightNode]| {
        below[1..].iter().fold(below[0], |top, leaf| LightNode {
            lower: Vec3::from(top.lower).min(leaf.lower.into()).to_array(),
            upper: Vec3::from(top.upper).max(leaf.upper.into()).to_array(),
            count: top.count + leaf.count,
            ..top
        })
    };
    let mut nodes: Vec<LightNode> = leaves.chunks(FAN).map(top).collect();
    // No box meets the last top node's missing leaves.
    let nowhere = LightNode {
        lower: [f32::INFINITY; 3],
        first: lights.len() as u32,
        upper: [f32::NEG_INFINITY; 3],
        count: 0,
    };
    let all = nodes.len() * (1 + FAN);
    nodes.extend(leaves);
    nodes.resize(all, nowhere);
    nodes
}

/// The box of the lights' spheres.
fn bounds(lights: &[PointLight]) -> (Vec3, Vec3) {
    lights.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lower, upper), light| {
        // Wider than the sphere by more than the test of a light against a cluster allows for rounding.
        let reach = light.range.unwrap_or(f32::MAX) * 1.0001 + 1e-6 * light.position.abs().max_element();
        (lower.min(light.position - reach), upper.max(light.position + reach))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lights(count: usize) -> Vec<PointLight> {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        (0..count)
            .map(|_| PointLight {
                position: Vec3::new(next(), next(), next()) * 10.0,
                intensity: Vec3::ONE,
                range: Some(0.1 + next()),
            })
            .collect()
    }

    #[test]
    fn every_light_is_in_one_leaf_and_inside_every_box_above_it() {
        for count in [1, 15, 16, 17, 128, 129, 5000] {
            let tree = LightTree::new(&lights(count));
            let mut seen = vec![0; count];
            let tops = tree.top_nodes() as usize;
            let (top_nodes, leaves) = tree.nodes.split_at(tops);
            assert_eq!(leaves.len(), tops * FAN);
            for (i, leaf) in leaves.iter().enumerate() {
                let lights = leaf.first as usize..(leaf.first + leaf.count) as usize;
                assert!(lights.is_empty() || lights.start == i * LEAF);
                for (light, seen) in tree.lights[lights.clone()].iter().zip(&mut seen[lights]) {
                    *seen += 1;
                    let range = light.range.unwrap();
                    for node in [leaf, &top_nodes[i / FAN]] {
                        assert!(light.position.cmpge(Vec3::from(node.lower) + range).all());
                        assert!(light.position.cmple(Vec3::from(node.upper) - range).all());
                    }
                }
            }
            assert_eq!(seen, vec![1; count]);
        }
    }

    /// Surface of the spheres of all nodes that do not hold a light beyond 100 m.
    fn surface(tree: &LightTree) -> f64 {
        let (_, nodes) = tree.moments.split_last().unwrap();
        nodes.iter().filter(|node| node.radius < 100.0).map(|node| f64::from(node.radius).powi(2)).sum()
    }

    #[test]
    fn lights_far_from_all_others_leave_these_in_order() {
        let mut all = lights(30_000);
        all.iter_mut().for_each(|light| light.range = None);
        let alone = surface(&LightTree::new(&all));
        for far in [Vec3::splat(1e3), Vec3::X * 1e6, Vec3::NEG_Y * 1e6, Vec3::new(-1e9, 1e12, 3e5)] {
            let mut with = all.clone();
            with[17].position = far;
            let tree = LightTree::new(&with);
            let found = surface(&tree);
            assert!(found < 1.2 * alone && found > alone / 1.2, "{far}: {found}, {alone} without");
        }
    }

    #[test]
    fn unranged_lights_follow_the_ranged_ones() {
        let mut all = lights(10);
        all[3].range = None;
        let tree = LightTree::new(&all);
        assert_eq!(tree.ranged, 9);
        assert_eq!(tree.lights[9], all[3]);
        assert!(LightTree::new(&[]).nodes.is_empty());
    }
}
