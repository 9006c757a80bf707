//! Every image that the frame renders into.

use crate::error::Result;
use crate::gpu::{Device, Format, Image, ImageDescription, Use};
use crate::shared::NO_CLUSTER;
use std::sync::Arc;

/// Scene-linear colour: float32, because subpasses and samples add up in it.
pub const HDR_FORMAT: Format = Format::R32G32B32A32_SFLOAT;
/// Display-referred colour, encoded by the present pass.
pub const LDR_FORMAT: Format = Format::R8G8B8A8_UNORM;
/// The normal's bits, and a word of material and variant.
pub const SURFACE_FORMAT: Format = Format::R32G32B32A32_UINT;
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
    /// What the prepass notes of each pixel's surface, for shaders that have no attributes of it; a single texel where none
    /// asks.
    pub surface: Image,
}

impl Targets {
    /// Makes the images; that of `surface`s only where something reads it. With `cuts`, compute looks at the colour.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, size: [u32; 2], surface: bool, cuts: bool) -> Result<Self> {
        let image = |name, format, uses: &[Use]| {
            Image::new(device, &ImageDescription { name, format, size, layers: None, mips: 1, uses })
        };
        let cluster_ids = image(
            "cluster ids",
            Format::R32_UINT,
            &[Use::TransferWrite, Use::TransferRead, Use::ComputeWrite, Use::FragmentRead],
        )?;
        // No clusters until the cluster pass has run, which it never does for a scene that has no use for it.
        let nothing = vec![NO_CLUSTER; size[0] as usize * size[1] as usize];
        cluster_ids.upload(&[&nothing], Use::FragmentRead)?;
        let mut hdr = vec![Use::ColorWrite, Use::InputRead, Use::TransferRead];
        if surface {
            hdr.extend([Use::TransferWrite, Use::ComputeWrite]);
        }
        if cuts {
            hdr.push(Use::ComputeRead);
        }
        Ok(Self {
            surface: surface_image(device, surface.then_some(size))?,
            depth: image("depth", DEPTH_FORMAT, &[Use::DepthWrite, Use::DepthRead])?,
            hdr: image("hdr", HDR_FORMAT, &hdr)?,
            ldr: image("ldr", LDR_FORMAT, &[Use::ColorWrite, Use::TransferRead])?,
            cluster_ids,
        })
    }
}

/// Of a picture's size, or a texel that no pass writes.
fn surface_image(device: &Arc<Device>, size: Option<[u32; 2]>) -> Result<Image> {
    let description = ImageDescription {
        name: "surface",
        format: SURFACE_FORMAT,
        size: size.unwrap_or([1, 1]),
        layers: None,
        mips: 1,
        uses: &[Use::ColorWrite, Use::TransferWrite, Use::ComputeRead],
    };
    let image = Image::new(device, &description)?;
    if size.is_none() {
        image.upload(&[&[[0_u32; 4]]], Use::ComputeRead)?;
    }
    Ok(image)
}
