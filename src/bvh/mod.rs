//! What hides lights, as a tree that shaders walk: the scene's triangles, with their masks, and the luminaires that are
//! seen.
//!
//! 1. `split.rs` makes a binary tree by the surface area heuristic; the same scene gives the same tree on any number of
//!    threads.
//! 2. Nodes lie in depth-first order, each with the index of the node that follows where it is missed: a walk needs
//!    no stack. `grid.rs` packs each of them into a texel.
//! 3. [`Bvh::texels`]: nodes, triangles, texture coordinates of masked triangles, and masks (`masks.rs`) in one run of
//!    texels.
//! 4. [`Bvh::ordered_nodes`]: the nodes in other orders, for nearest hits (`order.rs`).

mod grid;
mod masks;
mod order;
mod split;

use crate::scene::{Luminaire, Scene};
use crate::shared::{
    BVH_COUNT_BITS, BVH_HEADER_TEXELS, BVH_LEAF_BIT, BVH_TRIANGLE_TEXELS, BvhHeader, BvhNode, BvhTriangle,
    MaskedTriangle,
};
use glam::Vec3;
use grid::Grid;
use masks::Masks;
use split::{Item, Node};

/// Four words, as the device's texture holds them.
pub type Texel = [u32; 4];

/// A tree over occluders.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    /// In depth-first order.
    nodes: Vec<Node>,
    /// In the order of the leaves.
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

    /// In the order of the leaves.
    #[must_use]
    pub fn triangles(&self) -> &[BvhTriangle] {
        &self.triangles
    }

    /// Whether masks cut any of them.
    #[must_use]
    pub fn has_masks(&self) -> bool {
        !self.masked.is_empty()
    }

    /// The nodes in [`HIT_ORDERS`](crate::shared::HIT_ORDERS) orders, one after the other.
    #[must_use]
    pub fn ordered_nodes(&self) -> Vec<BvhNode> {
        order::orders(&self.nodes).iter().flat_map(|nodes| self.packed(nodes)).collect()
    }

    fn triangles_at(&self) -> u32 {
        BVH_HEADER_TEXELS + self.nodes.len() as u32
    }

    fn grid(&self) -> Grid {
        self.nodes.first().map_or(Grid::UNIT, |root| Grid::new(&root.bounds))
    }

    fn packed(&self, nodes: &[Node]) -> Vec<BvhNode> {
        let (grid, triangles_at) = (self.grid(), self.triangles_at());
        let node = |node: &Node| {
            let [x, y, z] = grid.cells(&node.bounds);
            let (first, count) = node.items;
            let leaf = BVH_LEAF_BIT | (triangles_at + first * BVH_TRIANGLE_TEXELS) << BVH_COUNT_BITS | count;
            BvhNode { x, y, z, next: if count == 0 { node.skip } else { leaf } }
        };
        nodes.iter().map(node).collect()
    }

    /// Everything as the device's texture holds it, from the header on.
    #[must_use]
    pub fn texels(&self) -> Vec<Texel> {
        let masked_at = self.triangles_at() + self.triangles.len() as u32 * BVH_TRIANGLE_TEXELS;
        let masks_at = masked_at + 2 * self.masked.len() as u32;
        let grid = self.grid();
        let header = BvhHeader {
            lower: grid.lower.to_array(),
            nodes: self.nodes.len() as u32,
            cell: grid.cell.to_array(),
            triangles: self.triangles.len() as u32,
        };
        let triangle = |triangle: &BvhTriangle| BvhTriangle {
            // Numbered from 1; 0 is no mask.
            masked: triangle.masked.checked_sub(1).map_or(0, |index| masked_at + 2 * index),
            ..*triangle
        };
        let masked =
            |masked: &MaskedTriangle| MaskedTriangle { words: 4 * masks_at + masked.words, ..*masked };
        let nodes = self.packed(&self.nodes);
        let triangles: Vec<_> = self.triangles.iter().map(triangle).collect();
        let masked: Vec<_> = self.masked.iter().map(masked).collect();
        let parts: [&[Texel]; 5] = [
            bytemuck::cast_slice(std::slice::from_ref(&header)),
            bytemuck::cast_slice(&nodes),
            bytemuck::cast_slice(&triangles),
            bytemuck::cast_slice(&masked),
            self.masks.as_chunks::<4>().0,
        ];
        parts.concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Mesh, Vertex};
    use glam::vec3;

    /// `count` triangles of a coarse grid, many of them in the same place.
    fn triangles(count: u32) -> Vec<BvhTriangle> {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            ((state >> 20) as f32 / 64.0).round()
        };
        let mut place = || [next(), next(), 0.5 * next()];
        (0..count)
            .map(|triangle| BvhTriangle {
                a: place(),
                b: place(),
                c: place(),
                triangle,
                ..BvhTriangle::default()
            })
            .collect()
    }

    #[test]
    fn every_triangle_is_in_one_leaf_and_inside_every_box_above_it() {
        for count in [1, 4, 5, 300, 20_000] {
            let all = triangles(count);
            let bvh = Bvh::over(all.clone(), Masks::default());
            let grid = Grid::new(&bvh.nodes[0].bounds);
            let mut seen = vec![0; all.len()];
            for (index, node) in bvh.nodes.iter().enumerate() {
                assert!(node.skip as usize > index && node.skip as usize <= bvh.nodes.len());
                assert!(node.items.1 == 0 || node.skip as usize == index + 1);
                let cells = grid.cells(&node.bounds);
                for below in &bvh.nodes[index..node.skip as usize] {
                    let (first, count) = below.items;
                    for triangle in &bvh.triangles[first as usize..][..count as usize] {
                        seen[triangle.triangle as usize] += u32::from(std::ptr::eq(node, below));
                        for corner in [triangle.a, triangle.b, triangle.c].map(Vec3::from) {
                            let place = (corner - grid.lower).as_dvec3() / grid.cell.as_dvec3();
                            let inside = |axis: usize| {
                                let cell = cells[axis];
                                (f64::from(cell & 0xffff)..=f64::from(cell >> 16)).contains(&place[axis])
                            };
                            assert!((0..3).all(inside), "{place} outside {cells:x?}");
                        }
                    }
                }
            }
            assert_eq!(seen, vec![1; all.len()]);
        }
    }

    #[test]
    fn orders_hold_the_same_tree_with_near_children_first() {
        let bvh = Bvh::over(triangles(3000), Masks::default());
        let leaves = |nodes: &[Node]| {
            let mut leaves: Vec<_> =
                nodes.iter().map(|node| node.items).filter(|items| items.1 > 0).collect();
            leaves.sort_unstable();
            leaves
        };
        let orders = order::orders(&bvh.nodes);
        for (octant, nodes) in orders.iter().enumerate() {
            assert_eq!((nodes.len(), leaves(nodes)), (bvh.nodes.len(), leaves(&bvh.nodes)));
            let mut near = 0;
            for (index, node) in nodes.iter().enumerate() {
                let end = node.skip as usize;
                assert!(end > index && end <= nodes.len() && (node.items.1 == 0 || end == index + 1));
                let inside = |below: &Node| {
                    below.bounds.lower.cmpge(node.bounds.lower).all()
                        && below.bounds.upper.cmple(node.bounds.upper).all()
                };
                assert!(nodes[index..end].iter().all(inside));
                if node.items.1 == 0 {
                    let [first, second] =
                        [index + 1, nodes[index + 1].skip as usize].map(|i| nodes[i].bounds);
                    let apart = (second.lower + second.upper) - (first.lower + first.upper);
                    let along = Vec3::from_array([0, 1, 2].map(|i| [1.0, -1.0][octant >> i & 1])) * apart;
                    near += usize::from(along[apart.abs().max_position()] >= 0.0);
                }
            }
            assert_eq!(near, nodes.iter().filter(|node| node.items.1 == 0).count());
        }
    }

    #[test]
    fn same_tree_on_any_number_of_threads() {
        let all = triangles(30_000);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Bvh::over(all.clone(), Masks::default()).texels())
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn one_place_and_no_place() {
        assert_eq!(Bvh::default().texels().len(), 2);
        let corner = Vertex { position: vec3(1.0, 2.0, 3.0).to_array(), ..Vertex::default() };
        let mesh = Mesh { vertices: vec![corner], triangles: vec![[0; 3]; 100], material: 0 };
        let bvh = Bvh::new(&Scene { meshes: vec![mesh], ..Scene::default() }, Vec3::ZERO);
        assert_eq!(bvh.triangles().len(), 100);
        assert!(bvh.texels()[..2].iter().flatten().all(|&word| f32::from_bits(word).is_finite()));
    }
}
