//! A scene-linear picture from elsewhere, developed as the frame's own: exposure, tone curve, encoding.

use super::present::{Looks, Present};
use super::{PassInputs, View};
use crate::error::Result;
use crate::gpu::{
    Attachment, DescriptorSets, Device, Framebuffer, Image, ImageDescription, Outside, RenderPass, Subpass,
    Use,
};
use crate::shared;
use crate::targets::{HDR_FORMAT, ldr_format};
use std::sync::Arc;

/// The pass and its images.
pub struct Develop {
    pass: RenderPass,
    framebuffer: Framebuffer,
    present: Present,
    set: DescriptorSets,
    hdr: Image,
    ldr: Image,
    device: Arc<Device>,
}

impl Develop {
    /// For pictures of `size` pixels.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, looks: Looks, size: [u32; 2]) -> Result<Self> {
        let format = ldr_format(looks.encoding);
        let image = |name, format, uses: &[Use]| {
            Image::new(inputs.device, &ImageDescription { name, format, size, layers: None, mips: 1, uses })
        };
        let hdr = image("linear", HDR_FORMAT, &[Use::TransferWrite, Use::InputRead])?;
        let ldr = image("developed", format, &[Use::ColorWrite, Use::TransferRead])?;
        let pass = RenderPass::new(
            inputs.device,
            "develop",
            &[
                Attachment { format: HDR_FORMAT, before: Use::InputRead, after: Use::InputRead },
                Attachment { format, before: Use::Nothing, after: Use::TransferRead },
            ],
            &[Subpass { color: &[1], input: &[0], depth: None }],
            &[],
            &[
                Outside::Before(Use::TransferRead, Use::ColorWrite),
                Outside::Before(Use::TransferWrite, Use::InputRead),
                Outside::After(Use::ColorWrite, Use::TransferRead),
            ],
        )?;
        let set = inputs.scene.layout.allocate(shared::frame::SET, 1)?;
        set.get(0).image(shared::frame::FRAME_HDR, &hdr, Use::InputRead);
        Ok(Self {
            framebuffer: Framebuffer::new(inputs.device, &pass, &[&hdr, &ldr])?,
            present: Present::new(inputs, looks, (&pass, 0))?,
            pass,
            set,
            hdr,
            ldr,
            device: inputs.device.clone(),
        })
    }

    /// Develops a picture, four numbers a pixel, times `scale`.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn develop(&self, view: &View<'_>, pixels: &[[f32; 4]], scale: f32) -> Result<()> {
        self.hdr.upload(&[pixels], Use::InputRead)?;
        let view = View { frame: self.set.get(0), ..*view };
        self.device.run("develop", |cmd| {
            cmd.begin_pass(&self.pass, &self.framebuffer);
            self.present.record(cmd, &view, [scale, 0.0]);
            cmd.end_pass();
            Ok(())
        })
    }

    /// What was developed last, in use [`Use::TransferRead`].
    #[must_use]
    pub fn image(&self) -> &Image {
        &self.ldr
    }
}
