//! Normals, texture coordinates, tangents and materials of the tree's triangles.

use crate::bvh::{Bvh, Texel};
use crate::gpu_scene::is_anisotropic;
use crate::scene::{Material, Parameter, Scene, Vertex};
use crate::shared::{
    BvhTriangle, HIT_LUMINAIRE, HIT_TANGENTS, HIT_TRIANGLE_TEXELS, HitTangents, HitTriangle,
};

/// In the order of the tree's triangles, and behind them the tangents.
#[derive(Default)]
pub(super) struct Surfaces {
    triangles: Vec<HitTriangle>,
    tangents: Vec<HitTangents>,
}

impl Surfaces {
    /// As they lie from texel `first` on.
    pub(super) fn new(scene: &Scene, bvh: &Bvh, first: usize) -> Self {
        let mut all = Self::default();
        let tangents_at = first + bvh.triangles().len() * HIT_TRIANGLE_TEXELS as usize;
        for triangle in bvh.triangles() {
            all.push(scene, triangle, tangents_at);
        }
        all
    }

    fn push(&mut self, scene: &Scene, triangle: &BvhTriangle, tangents_at: usize) {
        // Luminaires follow the scene's meshes.
        let Some(mesh) = scene.meshes.get(triangle.mesh as usize) else {
            self.triangles.push(HitTriangle { surface: HIT_LUMINAIRE, ..HitTriangle::default() });
            return;
        };
        let corners = mesh.triangles[triangle.triangle as usize].map(|index| mesh.vertices[index as usize]);
        let mut surface = mesh.material;
        if has_tangents(&scene.materials[mesh.material as usize]) {
            surface = HIT_TANGENTS | (tangents_at + 3 * self.tangents.len()) as u32;
            self.tangents.push(tangents(corners, mesh.material));
        }
        let [a, b, c] = corners;
        self.triangles.push(HitTriangle {
            normal_a: a.normal,
            surface,
            normal_b: b.normal,
            u_a: a.uv[0],
            normal_c: c.normal,
            v_a: a.uv[1],
            uv_bc: [b.uv[0], b.uv[1], c.uv[0], c.uv[1]],
        });
    }

    pub(super) fn append(&self, texels: &mut Vec<Texel>) {
        texels.extend_from_slice(bytemuck::cast_slice(&self.triangles));
        texels.extend_from_slice(bytemuck::cast_slice(&self.tangents));
    }
}

fn has_tangents(material: &Material) -> bool {
    is_anisotropic(material) || material.value(Parameter::Normal).texture.is_some()
}

fn tangents(corners: [Vertex; 3], material: u32) -> HitTangents {
    let handed = corners.iter().map(|corner| corner.tangent[3]).sum();
    let [a, b, c] = corners.map(|Vertex { tangent: [x, y, z, _], .. }| [x, y, z]);
    HitTangents { a, material, b, handed, c, spare: 0 }
}
