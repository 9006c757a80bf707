//! Depth only, reversed; masked materials are tested.
//!
//! Reads the triangles of scene and luminaires, writes depth. Cheap beside shading, and it removes all overdraw from it.

use super::luminaires::Luminaires;
use super::{PassInputs, View, draw_scene};
use crate::error::Result;
use crate::gpu::{
    Attachment, Commands, DepthTest, Framebuffer, GraphicsDescription, GraphicsPipeline, Outside, RenderPass,
    Subpass, Use, shaders,
};
use crate::gpu_scene::Variant;
use crate::targets::{DEPTH_FORMAT, Targets};

/// The depth prepass.
pub struct Prepass {
    pass: RenderPass,
    framebuffer: Framebuffer,
    // By variant.
    pipelines: Vec<GraphicsPipeline>,
    luminaires: Option<Luminaires>,
}

impl Prepass {
    /// Makes pass and pipelines.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets) -> Result<Self> {
        let pass = RenderPass::new(
            inputs.device,
            "prepass",
            &[Attachment { format: DEPTH_FORMAT, before: Use::Nothing, after: Use::DepthRead }],
            &[Subpass { depth: Some((0, Use::DepthWrite)), ..Subpass::default() }],
            &[],
            // The last frame's readers, then this frame's clustering.
            &[
                Outside::Before(Use::DepthRead, Use::DepthWrite),
                Outside::After(Use::DepthWrite, Use::DepthRead),
            ],
        )?;
        let framebuffer = Framebuffer::new(inputs.device, &pass, &[&targets.depth])?;
        let pipeline = |variant: &Variant| {
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: "prepass",
                    vertex: shaders::PREPASS_SURFACE_VERT,
                    fragment: variant.masked.then_some(shaders::PREPASS_MASK_FRAG),
                    specialization: &variant.specialization,
                    vertices: true,
                    depth: DepthTest::WriteNearest,
                    blend: None,
                    cull: variant.cull(),
                    pass: &pass,
                    subpass: 0,
                },
            )
        };
        let pipelines = inputs.scene.variants.iter().map(pipeline).collect::<Result<_>>()?;
        let seen = !inputs.scene.area.luminaires.is_empty();
        let luminaires = seen.then(|| Luminaires::prepass(inputs, &pass)).transpose()?;
        Ok(Self { pass, framebuffer, pipelines, luminaires })
    }

    /// Draws the scene's depth.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        cmd.labelled("prepass", |cmd| {
            cmd.begin_pass(&self.pass, &self.framebuffer);
            draw_scene(cmd, view, [0; 2], |variant| &self.pipelines[variant]);
            if let Some(luminaires) = &self.luminaires {
                luminaires.draw(cmd, view);
            }
            cmd.end_pass();
        });
    }
}
