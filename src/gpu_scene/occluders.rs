//! What hides lights, on the device.

use crate::bvh::Bvh;
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Format, Image, ImageDescription, Use};
use crate::shared::{self, BVH_HEIGHT_LOG2, BVH_WIDTH_LOG2};
use std::sync::Arc;

/// The texture that `glsl/bind/bvh.glsl` reads.
pub struct Occluders(Image);

impl Occluders {
    /// Uploads a tree; an empty one hides nothing.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, bvh: &Bvh) -> Result<Self> {
        let (width, most) = (1 << BVH_WIDTH_LOG2, 1 << BVH_HEIGHT_LOG2);
        let mut texels = bvh.texels();
        let rows = texels.len().div_ceil(width);
        let layers = rows.div_ceil(most);
        let height = if layers > 1 { most } else { rows };
        texels.resize(layers * height * width, [0; 4]);
        let image = Image::new(
            device,
            &ImageDescription {
                name: "occluders",
                format: Format::R32G32B32A32_UINT,
                size: [width as u32, height as u32],
                layers: Some(layers as u32),
                mips: 1,
                uses: &[Use::TransferWrite, Use::Texture],
            },
        )?;
        image.upload(&[&texels], Use::Texture)?;
        Ok(Self(image))
    }

    /// Puts it into a scene's set.
    pub fn bind(&self, scene: DescriptorSet<'_>) {
        scene.image(shared::scene::SCENE_BVH, &self.0, Use::Texture);
    }
}
