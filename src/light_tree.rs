//! Point lights in the order the device wants them, and the tree over that order.
//!
//! 1. Lights with a range come first, then those without; each kind along a Hilbert curve through its bounds.
//! 2. Every 32 lights with a range make a leaf, every 8 nodes a parent; a node's box holds its lights' spheres.
//! 3. Nodes lie in depth-first order, each with the index of the node that follows where it is missed: a walk needs
//!    no stack.

use crate::hilbert;
use crate::scene::PointLight;
use crate::shared::{LEAF_COUNT_BITS, LEAF_LIGHTS, LightNode};
use glam::Vec3;

/// Lights of a leaf.
const LEAF: usize = LEAF_LIGHTS as usize;
/// Children of an inner node.
const FAN: usize = 8;

/// Lights in device order, and their tree.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    /// Lights, those with a range first.
    pub lights: Vec<PointLight>,
    /// How many have a range.
    pub ranged: usize,
    /// Nodes over the lights with a range, in depth-first order.
    pub nodes: Vec<LightNode>,
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
        Self { lights: ordered, ranged, nodes }
    }
}

/// Appends those lights that have a range, or those that have none, in their curve's order.
fn append_along_curve(lights: &[PointLight], ranged: bool, ordered: &mut Vec<PointLight>) {
    let of_kind = |light: &PointLight| light.range.is_some() == ranged;
    let count = lights.iter().filter(|light| of_kind(light)).count();
    if count == lights.len() {
        let order = hilbert::order(lights.iter().map(|light| light.position));
        ordered.extend(order.into_iter().map(|index| lights[index as usize]));
    } else if count > 0 {
        let kind: Vec<_> = lights.iter().copied().filter(of_kind).collect();
        append_along_curve(&kind, ranged, ordered);
    }
}

fn build(lights: &[PointLight]) -> Vec<LightNode> {
    let mut nodes = Vec::new();
    if !lights.is_empty() {
        let mut span = LEAF;
        while span < lights.len() {
            span *= FAN;
        }
        emit(lights, 0, span, &mut nodes);
    }
    nodes
}

/// Appends the subtree over `lights`, the first of which has index `first`; its box.
fn emit(lights: &[PointLight], first: usize, span: usize, nodes: &mut Vec<LightNode>) -> [Vec3; 2] {
    let index = nodes.len();
    nodes.push(LightNode::default());
    let mut packed = 0;
    let [lower, upper] = if span == LEAF {
        packed = (first << LEAF_COUNT_BITS | lights.len()) as u32;
        bounds(lights)
    } else {
        let child = span / FAN;
        lights.chunks(child).enumerate().fold(
            [Vec3::INFINITY, Vec3::NEG_INFINITY],
            |[lower, upper], (i, part)| {
                let of_child = emit(part, first + i * child, child, nodes);
                [lower.min(of_child[0]), upper.max(of_child[1])]
            },
        )
    };
    let skip = nodes.len() as u32;
    nodes[index] = LightNode { lower: lower.to_array(), skip, upper: upper.to_array(), lights: packed };
    [lower, upper]
}

/// The box of the lights' spheres.
fn bounds(lights: &[PointLight]) -> [Vec3; 2] {
    lights.iter().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[lower, upper], light| {
        // Wider than the sphere by more than the test of a light against a cluster allows for rounding.
        let reach = light.range.unwrap_or(f32::MAX) * 1.0001 + 1e-6 * light.position.abs().max_element();
        [lower.min(light.position - reach), upper.max(light.position + reach)]
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
            for (i, node) in tree.nodes.iter().enumerate() {
                assert!(node.skip as usize > i && node.skip as usize <= tree.nodes.len());
                for below in &tree.nodes[i..node.skip as usize] {
                    let first = (below.lights >> LEAF_COUNT_BITS) as usize;
                    let leaf = first..first + (below.lights & 63) as usize;
                    for (place, seen) in tree.lights[leaf.clone()].iter().zip(&mut seen[leaf]) {
                        *seen += u32::from(std::ptr::eq(below, node));
                        let range = place.range.unwrap();
                        assert!(place.position.cmpge(Vec3::from(node.lower) + range).all());
                        assert!(place.position.cmple(Vec3::from(node.upper) - range).all());
                    }
                }
            }
            assert_eq!(seen, vec![1; count]);
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
