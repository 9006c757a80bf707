//! Subpass *indirect*: the many lights, through the lists of the clusters, but for variants that the resolve shades.

use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{Blend, Commands, RenderPass, shaders};
use crate::shared;

/// Pipelines of the subpass.
pub struct Indirect(SurfacePipelines);

impl Indirect {
    /// Makes one pipeline per variant; with a resolve, of those only that it leaves out; `folded` where some lists end in
    /// nodes of lights beyond the cap.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, resolve: bool, folded: bool, at: (&RenderPass, u32)) -> Result<Self> {
        let wanted = |variant| !(resolve && inputs.scene.resolved.has(variant));
        let extra = [(shared::SPEC_FOLDED, u32::from(folded))];
        SurfacePipelines::of(inputs, shaders::INDIRECT_MANY_FRAG, &extra, Blend::Add, at, wanted).map(Self)
    }

    /// Adds every listed light.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        self.0.draw(cmd, view, [0; 2]);
    }
}
