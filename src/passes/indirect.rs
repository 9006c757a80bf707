//! Subpass *indirect*: the many lights, through the lists of the clusters.

use super::{PassInputs, SurfacePipelines};
use crate::error::Result;
use crate::gpu::{Blend, Commands, DescriptorSet, RenderPass, shaders};
use crate::gpu_scene::GpuScene;

/// Pipelines of the subpass.
pub struct Indirect(SurfacePipelines);

impl Indirect {
    /// Makes one pipeline per variant.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, at: (&RenderPass, u32)) -> Result<Self> {
        SurfacePipelines::new(inputs, shaders::INDIRECT_MANY_FRAG, &[], Blend::Add, at).map(Self)
    }

    /// Adds every listed light.
    pub fn record(&self, cmd: &mut Commands, scene: &GpuScene, frame: DescriptorSet<'_>) {
        self.0.draw(cmd, scene, frame, [0; 2]);
    }
}
