//! Point lights in the order the device wants them, and the tree over that order.
//!
//! 1. Lights with a range come first, then those without; each kind along a Hilbert curve through its bounds.
//! 2. Every 32 lights with a range make a leaf, every 8 nodes a parent; a node's box holds its lights' spheres.
//! 3. Nodes lie in depth-first order, each with the index of the node that follows where it is missed: a walk needs
//!    no stack.
//! 4. Many lights without a range get a tree of their own, by [`moments`].

pub mod moments;

use crate::scene::PointLight;
use crate::shared::{LEAF_COUNT_BITS, LEAF_LIGHTS, LightNode, MomentNode};
use glam::Vec3;
use moments::LIGHTS_WITHOUT_CUT;
use rayon::prelude::*;

/// Lights of a leaf.
const LEAF: usize = LEAF_LIGHTS as usize;
/// Children of an inner node.
const FAN: usize = 8;
/// Bits per axis of the Hilbert curve.
const BITS: u32 = 10;

/// Lights in device order, and their tree.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    /// Lights, those with a range first.
    pub lights: Vec<PointLight>,
    /// How many have a range.
    pub ranged: usize,
    /// Nodes over the lights with a range, in depth-first order.
    pub nodes: Vec<LightNode>,
    /// Nodes over the lights without a range, in depth-first order, with a null node behind them; empty where the lights
    /// are few.
    pub moments: Vec<MomentNode>,
}

impl LightTree {
    /// Orders the lights and builds the tree.
    #[must_use]
    pub fn new(lights: &[PointLight]) -> Self {
        let (mut ordered, unranged): (Vec<_>, Vec<_>) =
            lights.iter().partition(|light| light.range.is_some());
        sort_along_curve(&mut ordered);
        let ranged = ordered.len();
        let nodes = build(&ordered);
        let mut unranged = unranged;
        sort_along_curve(&mut unranged);
        let moments =
            if unranged.len() > LIGHTS_WITHOUT_CUT { moments::build(&unranged, ranged) } else { vec![] };
        ordered.append(&mut unranged);
        Self { lights: ordered, ranged, nodes, moments }
    }
}

fn sort_along_curve(lights: &mut [PointLight]) {
    let lower = lights.iter().fold(Vec3::INFINITY, |least, light| least.min(light.position));
    let upper = lights.iter().fold(Vec3::NEG_INFINITY, |most, light| most.max(light.position));
    let extent = (upper - lower).max_element().max(f32::MIN_POSITIVE);
    // Stable: equal keys keep file order, so the result does not depend on the number of threads.
    lights.par_sort_by_cached_key(|light| hilbert_key((light.position - lower) / extent));
}

/// Position along the Hilbert curve of a point in the unit cube (Skilling 2004, transposed form).
fn hilbert_key(p: Vec3) -> u32 {
    let scale = ((1_u32 << BITS) - 1) as f32;
    let mut axes = (p * scale).to_array().map(|v| v as u32);
    let mut q = 1 << (BITS - 1);
    while q > 1 {
        let mask = q - 1;
        for i in 0..3 {
            if axes[i] & q != 0 {
                axes[0] ^= mask;
            } else {
                let t = (axes[0] ^ axes[i]) & mask;
                axes[0] ^= t;
                axes[i] ^= t;
            }
        }
        q >>= 1;
    }
    axes[1] ^= axes[0];
    axes[2] ^= axes[1];
    let mut t = 0;
    let mut q = 1 << (BITS - 1);
    while q > 1 {
        if axes[2] & q != 0 {
            t ^= q - 1;
        }
        q >>= 1;
    }
    let axes = axes.map(|axis| axis ^ t);
    (0..BITS).rev().fold(0, |key, bit| axes.iter().fold(key, |key, axis| key << 1 | (axis >> bit & 1)))
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

/// Appends the subtree over `lights`, the first of which has index `first`.
fn emit(lights: &[PointLight], first: usize, span: usize, nodes: &mut Vec<LightNode>) {
    let (lower, upper) = bounds(lights);
    let index = nodes.len();
    let leaf = span == LEAF;
    let packed = if leaf { (first << LEAF_COUNT_BITS | lights.len()) as u32 } else { 0 };
    nodes.push(LightNode { lower: lower.to_array(), skip: 0, upper: upper.to_array(), lights: packed });
    if !leaf {
        let child = span / FAN;
        for (i, part) in lights.chunks(child).enumerate() {
            emit(part, first + i * child, child, nodes);
        }
    }
    nodes[index].skip = nodes.len() as u32;
}

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
    fn neighbours_on_the_curve_are_neighbours_in_space() {
        let mut cells = vec![Vec3::ZERO; 512];
        for i in 0..512_u32 {
            let p = Vec3::new((i & 7) as f32, (i >> 3 & 7) as f32, (i >> 6) as f32);
            // The cell's corner on the grid of 2¹⁰: the top three bits of each axis.
            let key = hilbert_key((p * 128.0 + 0.5) / 1023.0) >> 21;
            cells[key as usize] = p;
        }
        for pair in cells.windows(2) {
            assert!((pair[0] - pair[1]).abs().element_sum() == 1.0, "{pair:?}");
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
