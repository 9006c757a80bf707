//! What reflects at each pixel, drawn against the frame's depth.

use crate::error::Result;
use crate::gpu::{
    Attachment, Blend, Commands, DescriptorSet, Device, Format, Framebuffer, Image, ImageDescription,
    Outside, RenderPass, Subpass, Use, shaders,
};
use crate::passes::{PassInputs, SurfacePipelines, View};
use crate::shared::gather::{GATHER_WORDS_A, GATHER_WORDS_B, GATHER_WORDS_C};
use crate::targets::{DEPTH_FORMAT, Targets};
use std::sync::Arc;

const FORMAT: Format = Format::R32G32B32A32_UINT;
/// The images' bindings, in the order of the attachments.
const BINDINGS: [u32; 3] = [GATHER_WORDS_A, GATHER_WORDS_B, GATHER_WORDS_C];

/// The pass that notes the surfaces, and its images.
pub(super) struct Surfaces {
    pass: RenderPass,
    images: Vec<Image>,
    framebuffer: Framebuffer,
    pipelines: SurfacePipelines,
}

impl Surfaces {
    pub(super) fn new(inputs: &PassInputs<'_>, targets: &Targets) -> Result<Self> {
        let pass = render_pass(inputs)?;
        let (images, framebuffer) = images(inputs.device, &pass, targets)?;
        let pipelines =
            SurfacePipelines::new(inputs, shaders::GATHER_SURFACE_FRAG, &[], Blend::Replace, (&pass, 0))?;
        Ok(Self { pass, images, framebuffer, pipelines })
    }

    pub(super) fn resize(&mut self, device: &Arc<Device>, targets: &Targets) -> Result<()> {
        (self.images, self.framebuffer) = images(device, &self.pass, targets)?;
        Ok(())
    }

    pub(super) fn bind(&self, set: DescriptorSet<'_>) {
        for (binding, image) in BINDINGS.into_iter().zip(&self.images) {
            set.image(binding, image, Use::ComputeRead);
        }
    }

    pub(super) fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        cmd.begin_pass(&self.pass, &self.framebuffer);
        self.pipelines.draw(cmd, view, [0; 2]);
        cmd.end_pass();
    }
}

fn images(device: &Arc<Device>, pass: &RenderPass, targets: &Targets) -> Result<(Vec<Image>, Framebuffer)> {
    let image = |_| {
        Image::new(
            device,
            &ImageDescription {
                name: "gather surfaces",
                format: FORMAT,
                size: targets.depth.size(),
                layers: None,
                mips: 1,
                uses: &[Use::ColorWrite, Use::ComputeRead],
            },
        )
    };
    let images: Vec<Image> = BINDINGS.iter().map(image).collect::<Result<_>>()?;
    let attachments: Vec<&Image> = images.iter().chain([&targets.depth]).collect();
    let framebuffer = Framebuffer::new(device, pass, &attachments)?;
    Ok((images, framebuffer))
}

fn render_pass(inputs: &PassInputs<'_>) -> Result<RenderPass> {
    let color = Attachment { format: FORMAT, before: Use::Nothing, after: Use::ComputeRead };
    let depth = Attachment { format: DEPTH_FORMAT, before: Use::DepthRead, after: Use::DepthRead };
    RenderPass::new(
        inputs.device,
        "gather surfaces",
        &[color, color, color, depth],
        &[Subpass { color: &[0, 1, 2], input: &[], depth: Some((3, Use::DepthTest)) }],
        &[],
        &[
            Outside::Before(Use::ComputeRead, Use::ColorWrite),
            Outside::Before(Use::DepthRead, Use::DepthTest),
            Outside::After(Use::ColorWrite, Use::ComputeRead),
            // Depth that is only read is stored again when the pass ends, and that counts as a write.
            Outside::After(Use::DepthWrite, Use::DepthRead),
        ],
    )
}
