//! Reversed depth; masked materials are tested. Where compute shades, what it needs of the surfaces too.
//!
//! Reads the triangles of scene and luminaires, writes depth and the surface image, if there is one. Cheap beside
//! shading, and it removes all overdraw from it.

use super::luminaires::Luminaires;
use super::{PassInputs, View, draw_scene};
use crate::error::Result;
use crate::gpu::{
    Attachment, Blend, Commands, DepthTest, Device, Framebuffer, GraphicsDescription, GraphicsPipeline,
    Outside, RenderPass, Subpass, Use, Vertices, shaders,
};
use crate::gpu_scene::Variant;
use crate::targets::{DEPTH_FORMAT, SURFACE_FORMAT, Targets};
use std::sync::Arc;

/// The depth prepass.
pub struct Prepass {
    pass: RenderPass,
    framebuffer: Framebuffer,
    // Whether the surface image is written.
    surface: bool,
    // By variant.
    pipelines: Vec<GraphicsPipeline>,
    luminaires: Option<Luminaires>,
}

impl Prepass {
    /// Makes pass and pipelines; with `surface`, they fill that image.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets, surface: bool) -> Result<Self> {
        let pass = render_pass(inputs, surface)?;
        let framebuffer = framebuffer(inputs.device, &pass, targets, surface)?;
        let fragment = |variant: &Variant| match surface {
            true => Some(shaders::PREPASS_SURFACE_FRAG),
            false => variant.masked.then_some(shaders::PREPASS_MASK_FRAG),
        };
        let pipeline = |variant: &Variant| {
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: "prepass",
                    vertex: shaders::PREPASS_SURFACE_VERT,
                    fragment: fragment(variant),
                    specialization: &variant.specialization,
                    vertices: Vertices::Surface,
                    depth: DepthTest::WriteNearest,
                    blend: surface.then_some(Blend::Replace),
                    cull: variant.cull(),
                    pass: &pass,
                    subpass: 0,
                },
            )
        };
        let pipelines = inputs.scene.variants.iter().map(pipeline).collect::<Result<_>>()?;
        let seen = !inputs.scene.area.luminaires.is_empty();
        let luminaires = seen.then(|| Luminaires::prepass(inputs, &pass, surface)).transpose()?;
        Ok(Self { pass, framebuffer, surface, pipelines, luminaires })
    }

    /// Binds other images.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn resize(&mut self, device: &Arc<Device>, targets: &Targets) -> Result<()> {
        self.framebuffer = framebuffer(device, &self.pass, targets, self.surface)?;
        Ok(())
    }

    /// Draws the scene's depth, and its surfaces.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        cmd.labelled("prepass", |cmd| {
            cmd.begin_pass(&self.pass, &self.framebuffer);
            draw_scene(cmd, view, [0; 2], |variant| Some(&self.pipelines[variant]));
            if let Some(luminaires) = &self.luminaires {
                luminaires.draw(cmd, view);
            }
            cmd.end_pass();
        });
    }
}

fn framebuffer(
    device: &Arc<Device>,
    pass: &RenderPass,
    targets: &Targets,
    surface: bool,
) -> Result<Framebuffer> {
    let images = [&targets.depth, &targets.surface];
    Framebuffer::new(device, pass, if surface { &images } else { &images[..1] })
}

fn render_pass(inputs: &PassInputs<'_>, surface: bool) -> Result<RenderPass> {
    let depth = Attachment { format: DEPTH_FORMAT, before: Use::Nothing, after: Use::DepthRead };
    let color = Attachment { format: SURFACE_FORMAT, before: Use::Nothing, after: Use::ComputeRead };
    let both = [depth, color];
    // The last frame's readers, then this frame's clustering.
    let mut outside = vec![
        Outside::Before(Use::DepthRead, Use::DepthWrite),
        Outside::After(Use::DepthWrite, Use::DepthRead),
    ];
    if surface {
        outside.extend([
            Outside::Before(Use::ComputeRead, Use::ColorWrite),
            Outside::After(Use::ColorWrite, Use::ComputeRead),
        ]);
    }
    RenderPass::new(
        inputs.device,
        "prepass",
        if surface { &both } else { &both[..1] },
        &[Subpass {
            color: if surface { &[1] } else { &[] },
            depth: Some((0, Use::DepthWrite)),
            ..Subpass::default()
        }],
        &[],
        &outside,
    )
}
