//! What hides lights, as a tree that shaders walk: the scene's triangles, with their masks, and the luminaires that are
//! seen.
//!
//! 1. [`build`]: a binary tree by the surface area heuristic over boxes ([`split`]); the same scene gives the same tree
//!    on any number of threads.
//! 2. Nodes lie in depth-first order, each with the index of the node that follows where it is missed: a walk needs
//!    no stack.
//! 3. [`texels`]: nodes, triangles, texture coordinates of masked triangles, and masks in one run of texels.

mod masks;
mod split;

use crate::scene::{Luminaire, Scene};
use crate::shared::{
    BVH_COUNT_BITS, BVH_NODE_TEXELS, BVH_TRIANGLE_TEXELS, BvhNode, BvhTriangle, MaskedTriangle,
};
use glam::Vec3;
use masks::Masks;
use split::Item;

/// Four words, as the device's texture holds them.
pub type Texel = [u32; 4];

/// A tree over occluders.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    /// Nodes in depth-first order; leaves hold indices into `triangles` here, and texels on the device.
    nodes: Vec<BvhNode>,
    triangles: Vec<BvhTriangle>,
    masked: Vec<MaskedTriangle>,
    masks: Vec<u32>,
}

impl Bvh {
    /// The tree over everything in `scene` that hides lights, of which `origin` becomes (0, 0, 0).
    #[must_use]
    pub fn new(scene: &Scene, origin: Vec3) -> Self {
        let mut masks = Masks::default();
        let mut triangles = Vec::new();
        for (index, mesh) in (0..).zip(&scene.meshes) {
            let mask = masks.of(scene, mesh.material);
            triangles.extend((0..).zip(&mesh.triangles).map(|(triangle, corners)| {
                let corners = corners.map(|corner| mesh.vertices[corner as usize]);
                let masked = mask.map_or(0, |mask| masks.cut(mask, corners.map(|corner| corner.uv)));
                let [a, b, c] = corners.map(|corner| (Vec3::from(corner.position) - origin).to_array());
                BvhTriangle { a, masked, b, mesh: index, c, triangle }
            }));
        }
        let seen = scene.area_lights.iter().filter(|light| light.visible);
        for (index, light) in (scene.meshes.len() as u32..).zip(seen) {
            let surface = Luminaire::new(light);
            let place =
                |corner: u32| (Vec3::from(surface.vertices[corner as usize].position) - origin).to_array();
            triangles.extend((0..).zip(&surface.triangles).map(|(triangle, corners)| {
                let [a, b, c] = corners.map(place);
                BvhTriangle { a, masked: 0, b, mesh: index, c, triangle }
            }));
        }
        Self::over(triangles, masks)
    }

    fn over(triangles: Vec<BvhTriangle>, masks: Masks) -> Self {
        let mut items: Vec<_> =
            (0..).zip(&triangles).map(|(index, triangle)| Item::new(index, triangle)).collect();
        let nodes = split::tree(&mut items);
        let triangles = items.iter().map(|item| triangles[item.index as usize]).collect();
        Self { nodes, triangles, masked: masks.triangles, masks: masks.words }
    }

    /// Triangles in the tree.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Everything as the device's texture holds it; one texel of zeros, which is a tree without nodes, where nothing is.
    #[must_use]
    pub fn texels(&self) -> Vec<Texel> {
        let triangles_at = self.nodes.len() as u32 * BVH_NODE_TEXELS;
        let masked_at = triangles_at + self.triangles.len() as u32 * BVH_TRIANGLE_TEXELS;
        let masks_at = masked_at + 2 * self.masked.len() as u32;
        let counted = (1 << BVH_COUNT_BITS) - 1;
        let node = |node: &BvhNode| {
            let (first, count) = (node.triangles >> BVH_COUNT_BITS, node.triangles & counted);
            let texel = triangles_at + first * BVH_TRIANGLE_TEXELS;
            BvhNode { triangles: if count == 0 { 0 } else { texel << BVH_COUNT_BITS | count }, ..*node }
        };
        let triangle = |triangle: &BvhTriangle| BvhTriangle {
            // Numbered from 1; 0 is no mask.
            masked: triangle.masked.checked_sub(1).map_or(0, |index| masked_at + 2 * index),
            ..*triangle
        };
        let masked =
            |masked: &MaskedTriangle| MaskedTriangle { words: 4 * masks_at + masked.words, ..*masked };
        let nodes: Vec<_> = self.nodes.iter().map(node).collect();
        let triangles: Vec<_> = self.triangles.iter().map(triangle).collect();
        let masked: Vec<_> = self.masked.iter().map(masked).collect();
        let mut texels: Vec<Texel> = bytemuck::cast_slice(&nodes).to_vec();
        texels.extend_from_slice(bytemuck::cast_slice(&triangles));
        texels.extend_from_slice(bytemuck::cast_slice(&masked));
        let (words, _) = self.masks.as_chunks::<4>();
        texels.extend_from_slice(words);
        texels.resize(texels.len().max(2), [0; 4]);
        texels
    }
}
