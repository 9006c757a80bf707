//! Trees over lights on the device: all in one texture of texels.

use crate::error::Result;
use crate::gpu::{Device, Image};
use crate::shared::{GATHERED_WIDTH_LOG2, GatherConstants};
use crate::virtual_lights::VirtualTree;
use std::sync::Arc;

/// Lights to gather from.
pub struct GatheredLights {
    pub(super) image: Image,
    pub(super) constants: GatherConstants,
}

impl GatheredLights {
    /// Uploads the scene's point lights, points on its area lights, and virtual lights; those of the latter that are nearer
    /// than some `spacing`s of theirs, metres, are left to paths.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, trees: [&VirtualTree; 3], spacing: f32) -> Result<Self> {
        let mut texels: Vec<[u32; 4]> = Vec::new();
        let [points, emitters, virtuals] = trees.map(|tree| {
            let first = texels.len() as u32;
            texels.extend_from_slice(bytemuck::cast_slice(&tree.pairs));
            texels.extend_from_slice(bytemuck::cast_slice(&tree.lights));
            [first, tree.lights.len() as u32]
        });
        let bound = bound(spacing);
        Ok(Self {
            image: Image::of_texels(device, "gathered lights", GATHERED_WIDTH_LOG2, &texels)?,
            constants: GatherConstants { points, emitters, virtuals, bound, ..GatherConstants::default() },
        })
    }
}

/// Spacings of virtual lights within which paths take over. The variance of 64 frames at 16 is .36 to .5 of that at 4, in
/// three rooms of 16,384 lights; at 32 a frame costs more than that saves.
const NEAR: f32 = 16.0;

/// Of lights a million metres apart.
const LEAST_BOUND: f32 = 1e-12;

/// Largest geometry term that gathering takes over, m⁻².
fn bound(spacing: f32) -> f32 {
    // Hardly a light: all is left to paths.
    if spacing > 0.0 { (NEAR * spacing).powi(2).recip().clamp(LEAST_BOUND, 1e12) } else { LEAST_BOUND }
}
