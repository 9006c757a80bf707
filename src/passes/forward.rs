//! The forward render pass: subpasses *direct*, *indirect* (only where the scene has lights with a range), *present*.
//!
//! Reads depth and light lists; adds radiance to the HDR image and writes the display-referred picture.

use super::direct::Direct;
use super::gather::Gathered;
use super::indirect::Indirect;
use super::present::{Looks, Present};
use super::{PassInputs, View};
use crate::error::Result;
use crate::gpu::{Attachment, Commands, Device, Framebuffer, Outside, RenderPass, Subpass, Timestamps, Use};
use crate::scene::settings::{Encoding, Tonemap};
use crate::targets::{DEPTH_FORMAT, HDR_FORMAT, Targets, ldr_format};
use std::sync::Arc;

const HDR: u32 = 0;
const LDR: u32 = 1;
const DEPTH: u32 = 2;

/// What the forward pass has to do for a scene; nothing else is compiled or recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    /// Point lights evaluated one by one.
    pub unranged: bool,
    /// Point lights without a range by cuts of their tree, instead.
    pub cut: bool,
    /// The first of them; the others follow.
    pub first_unranged: u32,
    /// Radiance where no surface is.
    pub background: bool,
    /// Point lights in lists.
    pub lists: bool,
    /// Compute shades them, where it can.
    pub resolve: bool,
    /// Fragments shade them, all or what compute cannot.
    pub indirect: bool,
    /// Some of the lists are folded.
    pub folded: bool,
    /// Area lights: how many; 0 where no surface is drawn.
    pub area: u32,
    /// Area lights through the masks of the clusters.
    pub masks: bool,
    /// Area lights that are seen.
    pub luminaires: bool,
    /// Light that is gathered, frame by frame.
    pub gathered: Gathered,
    /// Tone curve.
    pub tonemap: Tonemap,
    /// Encoding of the picture.
    pub encoding: Encoding,
}

impl Work {
    /// What the present subpass is made for.
    #[must_use]
    pub fn looks(&self) -> Looks {
        Looks { tonemap: self.tonemap, encoding: self.encoding, gathered: self.gathered }
    }
}

/// The forward pass.
pub struct Forward {
    // First sample: clears. Later samples: adds to what is there, as both do behind a resolve. Compatible, so pipelines
    // serve both.
    first: RenderPass,
    further: RenderPass,
    framebuffer: Framebuffer,
    direct: Direct,
    indirect: Option<Indirect>,
    present: Present,
}

impl Forward {
    /// Makes the pass and its subpasses.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets, work: Work) -> Result<Self> {
        let [first, further] =
            if work.resolve { [Use::ComputeWrite; 2] } else { [Use::Nothing, Use::TransferRead] }
                .map(|hdr| render_pass(inputs, work, hdr));
        let (first, further) = (first?, further?);
        let framebuffer = framebuffer(inputs.device, &first, targets)?;
        let indirect = work
            .indirect
            .then(|| Indirect::new(inputs, work.resolve, work.folded, (&first, 1)))
            .transpose()?;
        let last = if work.indirect { 2 } else { 1 };
        Ok(Self {
            direct: Direct::new(inputs, work, (&first, 0))?,
            indirect,
            present: Present::new(inputs, work.looks(), (&first, last))?,
            first,
            further,
            framebuffer,
        })
    }

    /// Changes the tone curve; the encoding has to be that of the targets.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn set_looks(&mut self, inputs: &PassInputs<'_>, looks: Looks) -> Result<()> {
        let last = if self.indirect.is_some() { 2 } else { 1 };
        self.present = Present::new(inputs, looks, (&self.first, last))?;
        Ok(())
    }

    /// Binds other images.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn resize(&mut self, device: &Arc<Device>, targets: &Targets) -> Result<()> {
        self.framebuffer = framebuffer(device, &self.first, targets)?;
        Ok(())
    }

    /// Adds one sample's radiance; the picture is the sum times `scale`. Timestamp `stamp` and those behind it follow
    /// each subpass.
    pub fn record(
        &self,
        cmd: &mut Commands,
        view: &View<'_>,
        sample: Sample,
        timestamps: (&Timestamps, u32),
    ) {
        let (timestamps, mut stamp) = timestamps;
        let mut done = |cmd: &mut Commands| {
            cmd.timestamp(timestamps, stamp);
            stamp += 1;
        };
        cmd.begin_pass(if sample.first { &self.first } else { &self.further }, &self.framebuffer);
        if sample.shaded {
            cmd.labelled("direct", |cmd| self.direct.record(cmd, view, sample.points));
        }
        done(cmd);
        if let Some(indirect) = &self.indirect {
            cmd.next_subpass();
            if sample.shaded && sample.points {
                cmd.labelled("indirect", |cmd| indirect.record(cmd, view));
            }
            done(cmd);
        }
        cmd.next_subpass();
        cmd.labelled("present", |cmd| self.present.record(cmd, view, sample.scales));
        cmd.end_pass();
        done(cmd);
    }
}

/// Which sample of a picture is rendered.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Clears what was there.
    pub first: bool,
    /// Whether it adds light, or the picture is only presented again.
    pub shaded: bool,
    /// Whether that light is also of point lights; otherwise it is gathered.
    pub points: bool,
    /// Factors on the sum of samples and on that of gathered light: exposure over the number of either so far.
    pub scales: [f32; 2],
}

fn framebuffer(device: &Arc<Device>, pass: &RenderPass, targets: &Targets) -> Result<Framebuffer> {
    Framebuffer::new(device, pass, &[&targets.hdr, &targets.ldr, &targets.depth])
}

fn render_pass(inputs: &PassInputs<'_>, work: Work, hdr_before: Use) -> Result<RenderPass> {
    let shading = Subpass { color: &[HDR], input: &[], depth: Some((DEPTH, Use::DepthTest)) };
    let present = Subpass { color: &[LDR], input: &[HDR], depth: None };
    let mut subpasses = vec![shading];
    let mut inside = Vec::new();
    if work.indirect {
        subpasses.push(shading);
        inside.push((Use::ColorWrite, Use::ColorWrite));
    }
    subpasses.push(present);
    inside.push((Use::ColorWrite, Use::InputRead));
    RenderPass::new(
        inputs.device,
        "forward",
        &[
            Attachment { format: HDR_FORMAT, before: hdr_before, after: Use::TransferRead },
            Attachment { format: ldr_format(work.encoding), before: Use::Nothing, after: Use::TransferRead },
            Attachment { format: DEPTH_FORMAT, before: Use::DepthRead, after: Use::DepthRead },
        ],
        &subpasses,
        &inside,
        &[
            Outside::Before(Use::TransferRead, Use::ColorWrite),
            Outside::Before(Use::ComputeWrite, Use::ColorWrite),
            Outside::Before(Use::DepthWrite, Use::DepthTest),
            Outside::Before(Use::DepthRead, Use::DepthTest),
            // The picture on its way to a window, which the present subpass draws anew.
            Outside::BeforeLast(Use::TransferRead, Use::ColorWrite),
            Outside::After(Use::ColorWrite, Use::TransferRead),
        ],
    )
}
