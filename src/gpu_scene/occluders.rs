//! What hides lights, on the device.

use crate::bvh::Bvh;
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Image, RayTree, Use};
use crate::shared::{self, BVH_WIDTH_LOG2};
use std::sync::Arc;

/// The texture that `glsl/bind/bvh.glsl` reads.
pub struct Occluders {
    /// Specialisation constants of what traces rays.
    pub specialization: Vec<(u32, u32)>,
    texels: Image,
    /// The driver's tree over the same triangles, which ray queries walk instead.
    ray_tree: Option<RayTree>,
}

impl Occluders {
    /// Uploads a tree; an empty one hides nothing.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short, or where there are more triangles than the device's textures hold:
    /// some four million, or sixteen on most.
    pub fn new(device: &Arc<Device>, bvh: &Bvh) -> Result<Self> {
        let texels = Image::of_texels(device, "occluders", BVH_WIDTH_LOG2, &bvh.texels())?;
        let specialization = vec![(shared::SPEC_OCCLUDER_MASKS, u32::from(bvh.has_masks()))];
        let ray_tree = || RayTree::new(device, bytemuck::cast_slice(bvh.triangles()));
        let ray_tree = device.has_ray_queries().then(ray_tree).transpose()?;
        Ok(Self { specialization, texels, ray_tree })
    }

    /// Puts it into a scene's set.
    pub fn bind(&self, scene: DescriptorSet<'_>) {
        scene.image(shared::scene::SCENE_BVH, &self.texels, Use::Texture);
        if let Some(tree) = &self.ray_tree {
            scene.ray_tree(shared::scene::SCENE_RAY_TREE, tree);
        }
    }
}
