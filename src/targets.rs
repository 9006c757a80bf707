//! Every image that the frame renders into.

use crate::error::Result;
use crate::gpu::{Device, Format, Image, ImageDescription, Use};
use crate::shared::NO_CLUSTER;
use std::sync::Arc;

/// Scene-linear colour: float32, because subpasses and samples add up in it.
pub const HDR_FORMAT: Format = Format::R32G32B32A32_SFLOAT;
/// Display-referred colour, encoded by the present pass.
pub const LDR_FORMAT: Format = Format::R8G8B8A8_UNORM;
/// Reversed depth.
pub const DEPTH_FORMAT: Format = Format::D32_SFLOAT;

/// The frame's images, all of one size.
pub struct Targets {
    /// Prepass depth.
    pub depth: Image,
    /// Scene-linear sum over samples.
    pub hdr: Image,
    /// Display-referred picture.
    pub ldr: Image,
    /// Cluster id per pixel.
    pub cluster_ids: Image,
}

impl Targets {
    /// Makes the images.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, size: [u32; 2]) -> Result<Self> {
        let image = |name, format, uses: &[Use]| {
            Image::new(device, &ImageDescription { name, format, size, layers: None, mips: 1, uses })
        };
        let cluster_ids = image(
            "cluster ids",
            Format::R32_UINT,
            &[Use::TransferWrite, Use::TransferRead, Use::ComputeWrite, Use::FragmentRead],
        )?;
        // No clusters until the cluster pass has run, which it never does for a scene without lights in lists.
        let nothing = vec![NO_CLUSTER; size[0] as usize * size[1] as usize];
        cluster_ids.upload(&[&nothing], Use::FragmentRead)?;
        Ok(Self {
            depth: image("depth", DEPTH_FORMAT, &[Use::DepthWrite, Use::DepthRead])?,
            hdr: image("hdr", HDR_FORMAT, &[Use::ColorWrite, Use::InputRead, Use::TransferRead])?,
            ldr: image("ldr", LDR_FORMAT, &[Use::ColorWrite, Use::TransferRead])?,
            cluster_ids,
        })
    }
}
