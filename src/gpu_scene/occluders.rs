//! What hides lights, on the device.

use crate::bvh::Bvh;
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Format, Image, ImageDescription, Use};
use crate::shared::{self, BVH_WIDTH_LOG2};
use std::sync::Arc;

/// The texture that `glsl/bind/bvh.glsl` reads.
pub struct Occluders {
    /// Specialisation constants of what traces rays.
    pub specialization: Vec<(u32, u32)>,
    texels: Image,
}

impl Occluders {
    /// Uploads a tree; an empty one hides nothing.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short, or where there are more triangles than the device's textures hold:
    /// some four million, or sixteen on most.
    pub fn new(device: &Arc<Device>, bvh: &Bvh) -> Result<Self> {
        let width = 1 << BVH_WIDTH_LOG2;
        let mut texels = bvh.texels();
        texels.resize(texels.len().next_multiple_of(width), [0; 4]);
        let image = Image::new(
            device,
            &ImageDescription {
                name: "occluders",
                format: Format::R32G32B32A32_UINT,
                size: [width as u32, (texels.len() / width) as u32],
                layers: None,
                mips: 1,
                uses: &[Use::TransferWrite, Use::Texture],
            },
        )?;
        image.upload(&[&texels], Use::Texture)?;
        let specialization = vec![(shared::SPEC_OCCLUDER_MASKS, u32::from(bvh.has_masks()))];
        Ok(Self { specialization, texels: image })
    }

    /// Puts it into a scene's set.
    pub fn bind(&self, scene: DescriptorSet<'_>) {
        scene.image(shared::scene::SCENE_BVH, &self.texels, Use::Texture);
    }
}
