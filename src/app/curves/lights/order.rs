//! Orders that lights may have on the device, which gives them the last; and what that does to the walks over their tree.

use crate::error::Result;
use crate::frame::Frame;
use crate::gpu::Use;
use crate::hilbert::sort;
use crate::light_tree::LightTree;
use crate::scene::PointLight;
use crate::shared::{Cluster, HILBERT_KEY_BITS as KEY_BITS, LightNode, TOP_LEAVES};
use glam::Vec3;

/// An order of lights with a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Order {
    /// The file's, which is random.
    AsStrewn,
    /// Along Morton's curve.
    Morton,
    /// Along Hilbert's.
    Hilbert,
}

/// Bits of Morton's keys along an axis.
const BITS: u32 = 10;

impl Order {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::AsStrewn => "as strewn",
            Self::Morton => "Morton",
            Self::Hilbert => "Hilbert",
        }
    }

    /// The tree over lights in that order, about an origin.
    pub(super) fn tree(self, lights: &[PointLight], origin: Vec3) -> LightTree {
        let order = match self {
            Self::AsStrewn => (0..lights.len() as u32).collect(),
            Self::Morton => sort::sort(morton_keys(lights)).0,
            Self::Hilbert => return LightTree::new(lights, origin),
        };
        let at = |&index: &u32| {
            let light = &lights[index as usize];
            PointLight { position: light.position - origin, ..*light }
        };
        LightTree::over(order.iter().map(at).collect(), lights.len())
    }
}

/// Keys of as many bits as the sort reads.
fn morton_keys(lights: &[PointLight]) -> Vec<u32> {
    let places = || lights.iter().map(|light| light.position);
    let lower = places().fold(Vec3::INFINITY, Vec3::min);
    let extent = (places().fold(Vec3::NEG_INFINITY, Vec3::max) - lower).max_element();
    let scale = ((1 << BITS) - 1) as f32 / extent.max(f32::MIN_POSITIVE);
    let key = |place: Vec3| {
        let [x, y, z] = ((place - lower) * scale).to_array().map(|v| thirds(v as u32));
        (x << 2 | y << 1 | z) << (KEY_BITS - 3 * BITS)
    };
    places().map(key).collect()
}

/// The last ten bits, three apart.
fn thirds(v: u32) -> u32 {
    let v = (v | v << 16) & 0x0300_00ff;
    let v = (v | v << 8) & 0x0300_f00f;
    let v = (v | v << 4) & 0x030c_30c3;
    (v | v << 2) & 0x0924_9249
}

/// Nodes of the tree over lights with a range that the last frame tested for its parents, as `glsl/cluster/gather.comp` walks it.
pub(super) fn nodes_visited(frame: &Frame) -> Result<u64> {
    let tree = &frame.scene().lights;
    let (_, targets) = frame.cluster_targets();
    let clusters = targets.clusters.fetch(Use::ComputeWrite)?;
    if tree.nodes.is_empty() {
        return Ok(0);
    }
    let parents = &clusters[targets.capacity.clusters as usize..];
    let parents = &parents[..frame.counters().parents as usize];
    Ok(parents.iter().map(|parent| visits(tree, bounds(parent, &clusters))).sum())
}

/// The box of a parent's children.
fn bounds(parent: &Cluster, clusters: &[Cluster]) -> [Vec3; 2] {
    let children = &clusters[parent.parent as usize..][..parent.children as usize];
    let start = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    children
        .iter()
        .fold(start, |[lower, upper], child| [lower.min(child.lower.into()), upper.max(child.upper.into())])
}

fn visits(tree: &LightTree, [lower, upper]: [Vec3; 2]) -> u64 {
    let fan = TOP_LEAVES as usize;
    let tops = tree.top_nodes() as usize;
    let (crowns, below) = tree.nodes.split_at(tops.div_ceil(fan));
    let (tops, leaves) = below.split_at(tops);
    let met = |node: &LightNode| {
        Vec3::from(node.lower).cmple(upper).all() && Vec3::from(node.upper).cmpge(lower).all()
    };
    let mut visits = crowns.len();
    for (_, tops) in
        crowns.iter().zip(tops.chunks(fan).zip(leaves.chunks(fan * fan))).filter(|(crown, _)| met(crown))
    {
        visits += tops.0.len();
        visits += tops.0.iter().filter(|top| met(top)).count() * fan;
    }
    visits as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All orders have all lights, and Hilbert's leaves are the smallest.
    #[test]
    fn orders_of_lights() {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        let light = |_| PointLight {
            position: Vec3::new(next(), next(), next()),
            intensity: Vec3::ONE,
            range: Some(0.01),
        };
        let lights: Vec<_> = (0..8192).map(light).collect();
        let volume = |order: Order| {
            let tree = order.tree(&lights, Vec3::ZERO);
            assert_eq!((tree.lights.len(), tree.ranged), (8192, 8192));
            let sum =
                |axis: fn(Vec3) -> f32| tree.lights.iter().map(|l| f64::from(axis(l.position))).sum::<f64>();
            let all = |axis: fn(Vec3) -> f32| lights.iter().map(|l| f64::from(axis(l.position))).sum::<f64>();
            assert!(
                (sum(|p| p.x + 2.0 * p.y + 4.0 * p.z) - all(|p| p.x + 2.0 * p.y + 4.0 * p.z)).abs() < 1e-6
            );
            let leaves = tree.nodes.iter().skip(1 + tree.top_nodes() as usize).filter(|leaf| leaf.count > 0);
            leaves
                .map(|leaf| (Vec3::from(leaf.upper) - Vec3::from(leaf.lower)).element_product())
                .sum::<f32>()
        };
        let [strewn, morton, hilbert] = [Order::AsStrewn, Order::Morton, Order::Hilbert].map(volume);
        assert!(strewn > 20.0 * morton && morton > 1.3 * hilbert, "{strewn} {morton} {hilbert}");
    }
}
