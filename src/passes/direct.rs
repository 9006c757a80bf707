//! Subpass *direct*: the background, and the lights that every pixel evaluates one by one.
//!
//! Today these are the point lights without a range: they reach everything, so a list would only repeat them.

use super::forward::Work;
use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{
    Blend, Commands, Cull, DepthTest, GraphicsDescription, GraphicsPipeline, RenderPass, Specialization,
    shaders,
};
use crate::shared;

/// Lights of one draw; the draws of a surface add up. lavapipe ends a shader's loops, without a word, after 65,535
/// iterations, and a GPU's watchdog ends draws that last seconds.
const LIGHTS_PER_DRAW: u32 = 1 << 15;

/// Pipelines of the subpass; absent where the scene has no use for them.
pub struct Direct {
    unranged: Option<SurfacePipelines>,
    background: Option<GraphicsPipeline>,
    first_light: u32,
}

impl Direct {
    /// Makes what the scene needs.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, work: Work, at: (&RenderPass, u32)) -> Result<Self> {
        let unranged = || SurfacePipelines::new(inputs, shaders::DIRECT_UNRANGED_FRAG, &[], Blend::Add, at);
        let background = || {
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: "background",
                    vertex: shaders::PRESENT_FULLSCREEN_VERT,
                    fragment: Some(shaders::DIRECT_BACKGROUND_FRAG),
                    specialization: &Specialization::default(),
                    vertices: false,
                    // The triangle lies at depth 0: it passes where the prepass left none.
                    depth: DepthTest::Equal,
                    blend: Some(Blend::Add),
                    cull: Cull::None,
                    pass: at.0,
                    subpass: at.1,
                },
            )
        };
        Ok(Self {
            unranged: work.unranged.then(unranged).transpose()?,
            background: work.background.then(background).transpose()?,
            first_light: work.first_unranged,
        })
    }

    /// Draws background and unranged lights.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        let count = view.scene.lights.lights.len() as u32;
        if let Some(background) = &self.background {
            cmd.bind_graphics(background);
            cmd.bind_sets(shared::frame::SET, &[view.frame]);
            cmd.draw_fullscreen();
        }
        if let Some(unranged) = &self.unranged {
            for first in (self.first_light..count).step_by(LIGHTS_PER_DRAW as usize) {
                let end = count.min(first + LIGHTS_PER_DRAW);
                unranged.draw(cmd, view, [first, end]);
            }
        }
    }
}
