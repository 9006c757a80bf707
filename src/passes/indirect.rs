//! Subpass *indirect*: the many lights, through the lists of the clusters.

use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{Blend, Commands, RenderPass, shaders};
use crate::shared;

/// Pipelines of the subpass.
pub struct Indirect(SurfacePipelines);

impl Indirect {
    /// Makes one pipeline per variant; `folded` where some lists end in nodes of lights beyond the cap.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, folded: bool, at: (&RenderPass, u32)) -> Result<Self> {
        let extra = [(shared::SPEC_FOLDED, u32::from(folded))];
        SurfacePipelines::new(inputs, shaders::INDIRECT_MANY_FRAG, &extra, Blend::Add, at).map(Self)
    }

    /// Adds every listed light.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        self.0.draw(cmd, view, [0; 2]);
    }
}
