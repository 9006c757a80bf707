//! Subpass *indirect*: the many lights, through the lists of the clusters.

use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{Blend, Commands, RenderPass, shaders};

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
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        self.0.draw(cmd, view, [0; 2]);
    }
}
