//! A picture beside the frame's: drawn against its depth, in numbers, and fetched.

use super::PassInputs;
use crate::error::Result;
use crate::gpu::{Attachment, Framebuffer, Image, ImageDescription, Outside, RenderPass, Subpass, Use};
use crate::targets::{DEPTH_FORMAT, HDR_FORMAT, Targets};

/// The image, and what draws into it.
pub(super) struct Sheet {
    pub(super) framebuffer: Framebuffer,
    pub(super) image: Image,
}

impl Sheet {
    pub(super) fn new(
        inputs: &PassInputs<'_>,
        targets: &Targets,
        pass: &RenderPass,
        name: &'static str,
    ) -> Result<Self> {
        let image = Image::new(
            inputs.device,
            &ImageDescription {
                name,
                format: HDR_FORMAT,
                size: targets.depth.size(),
                layers: None,
                mips: 1,
                uses: &[Use::ColorWrite, Use::TransferRead],
            },
        )?;
        Ok(Self { framebuffer: Framebuffer::new(inputs.device, pass, &[&image, &targets.depth])?, image })
    }
}

/// A render pass that clears a sheet and leaves it to be fetched; it runs after the frame.
pub(super) fn sheet_pass(inputs: &PassInputs<'_>, name: &'static str) -> Result<RenderPass> {
    RenderPass::new(
        inputs.device,
        name,
        &[
            Attachment { format: HDR_FORMAT, before: Use::Nothing, after: Use::TransferRead },
            Attachment { format: DEPTH_FORMAT, before: Use::DepthRead, after: Use::DepthRead },
        ],
        &[Subpass { color: &[0], input: &[], depth: Some((1, Use::DepthTest)) }],
        &[],
        &[
            Outside::Before(Use::TransferRead, Use::ColorWrite),
            Outside::Before(Use::ComputeWrite, Use::FragmentRead),
            // Depth that is only read is stored again when a pass ends, and that counts as a write.
            Outside::Before(Use::DepthWrite, Use::DepthTest),
            Outside::After(Use::ColorWrite, Use::TransferRead),
        ],
    )
}
