//! Render passes and their subpasses, described as data.

use super::device::Device;
use super::{Called, Image, Use, too_large};
use crate::error::Result;
use ash::vk;
use std::sync::Arc;

/// An attachment of a render pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Attachment {
    /// Texel format.
    pub format: vk::Format,
    /// Use before the pass; [`Use::Nothing`] lets the pass clear it, anything else keeps its contents.
    pub before: Use,
    /// Use after the pass.
    pub after: Use,
}

/// A subpass: indices of attachments.
#[derive(Clone, Copy, Debug, Default)]
pub struct Subpass<'a> {
    /// Colour attachments written.
    pub color: &'a [u32],
    /// Attachments read at the pixel.
    pub input: &'a [u32],
    /// Depth attachment, and whether it is written or only tested.
    pub depth: Option<(u32, Use)>,
}

impl Subpass<'_> {
    fn attachments(&self) -> impl Iterator<Item = u32> {
        self.color.iter().chain(self.input).copied().chain(self.depth.map(|(index, _)| index))
    }
}

/// All that a render pass is made from: what is compiled for one may be used in another of equal shape.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Shape {
    attachments: Vec<Attachment>,
    subpasses: Vec<SubpassShape>,
    inside: Vec<(Use, Use)>,
    outside: Vec<Outside>,
}

/// A [`Subpass`].
#[derive(Debug, PartialEq, Eq, Hash)]
struct SubpassShape {
    color: Vec<u32>,
    input: Vec<u32>,
    depth: Option<(u32, Use)>,
}

/// A render pass.
pub struct RenderPass {
    pub(super) raw: vk::RenderPass,
    pub(super) shape: Arc<Shape>,
    device: Arc<Device>,
}

impl RenderPass {
    /// A render pass whose subpasses run in order. `inside` holds, for each subpass after the first, the uses before
    /// and after the dependency on its predecessor, at the same pixel. `outside` are the uses before and after the
    /// whole pass.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        attachments: &[Attachment],
        subpasses: &[Subpass<'_>],
        inside: &[(Use, Use)],
        outside: &[Outside],
    ) -> Result<Self> {
        let descriptions: Vec<_> = attachments.iter().map(describe).collect();
        let references: Vec<_> =
            (0..subpasses.len()).map(|i| References::new(&subpasses[i], &subpasses[..i])).collect();
        let subpass_infos: Vec<_> = references.iter().map(References::describe).collect();
        let last = subpasses.len() as u32 - 1;
        let mut dependencies: Vec<_> = (0_u32..)
            .zip(inside)
            .map(|(from, &(before, after))| {
                dependency(from, from + 1, before, after).dependency_flags(vk::DependencyFlags::BY_REGION)
            })
            .collect();
        dependencies.extend(outside.iter().map(|edge| match *edge {
            Outside::Before(before, after) => dependency(vk::SUBPASS_EXTERNAL, 0, before, after),
            Outside::BeforeLast(before, after) => dependency(vk::SUBPASS_EXTERNAL, last, before, after),
            Outside::After(before, after) => dependency(last, vk::SUBPASS_EXTERNAL, before, after),
        }));
        let info = vk::RenderPassCreateInfo::default()
            .attachments(&descriptions)
            .subpasses(&subpass_infos)
            .dependencies(&dependencies);
        // SAFETY: every index names an attachment or subpass given above, as validation checks in tests.
        let raw = unsafe { device.raw.create_render_pass(&info, None) }.called("vkCreateRenderPass")?;
        device.name(raw, name);
        let of = |subpass: &Subpass<'_>| SubpassShape {
            color: subpass.color.to_vec(),
            input: subpass.input.to_vec(),
            depth: subpass.depth,
        };
        let shape = Shape {
            attachments: attachments.to_vec(),
            subpasses: subpasses.iter().map(of).collect(),
            inside: inside.to_vec(),
            outside: outside.to_vec(),
        };
        Ok(Self { raw, shape: Arc::new(shape), device: device.clone() })
    }

    /// Colour attachments of a subpass.
    pub(super) fn colors(&self, subpass: u32) -> usize {
        self.shape.subpasses[subpass as usize].color.len()
    }
}

/// A dependency on work outside the pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outside {
    /// Earlier work, then the first subpass.
    Before(Use, Use),
    /// Earlier work, then the last subpass: what is first used there changes its layout no sooner.
    BeforeLast(Use, Use),
    /// The last subpass, then later work.
    After(Use, Use),
}

impl Drop for RenderPass {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`.
        unsafe { self.device.raw.destroy_render_pass(self.raw, None) };
    }
}

fn describe(attachment: &Attachment) -> vk::AttachmentDescription {
    let fresh = attachment.before == Use::Nothing;
    vk::AttachmentDescription::default()
        .format(attachment.format)
        .samples(vk::SampleCountFlags::TYPE_1)
        .load_op(if fresh { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD })
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(attachment.before.layout())
        .final_layout(attachment.after.layout())
}

fn dependency(from: u32, to: u32, before: Use, after: Use) -> vk::SubpassDependency {
    let (src_stage, src_access, _) = before.scope();
    let (dst_stage, dst_access, _) = after.scope();
    vk::SubpassDependency::default()
        .src_subpass(from)
        .dst_subpass(to)
        .src_stage_mask(src_stage)
        .src_access_mask(src_access)
        .dst_stage_mask(dst_stage)
        .dst_access_mask(dst_access)
}

/// Keeps a subpass's attachment references alive.
struct References {
    color: Vec<vk::AttachmentReference>,
    input: Vec<vk::AttachmentReference>,
    depth: Option<vk::AttachmentReference>,
    // Used earlier but not here: without a word their contents would be lost from here on.
    preserved: Vec<u32>,
}

impl References {
    fn new(subpass: &Subpass<'_>, earlier: &[Subpass<'_>]) -> Self {
        let mut preserved: Vec<u32> = earlier.iter().flat_map(Subpass::attachments).collect();
        preserved.retain(|&attachment| subpass.attachments().all(|used| used != attachment));
        preserved.sort_unstable();
        preserved.dedup();
        let all = |indices: &[u32], used: Use| indices.iter().map(|&i| reference(i, used)).collect();
        Self {
            color: all(subpass.color, Use::ColorWrite),
            input: all(subpass.input, Use::InputRead),
            depth: subpass.depth.map(|(index, used)| reference(index, used)),
            preserved,
        }
    }

    fn describe(&self) -> vk::SubpassDescription<'_> {
        let info = vk::SubpassDescription::default()
            .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
            .color_attachments(&self.color)
            .input_attachments(&self.input)
            .preserve_attachments(&self.preserved);
        match &self.depth {
            Some(depth) => info.depth_stencil_attachment(depth),
            None => info,
        }
    }
}

fn reference(attachment: u32, used: Use) -> vk::AttachmentReference {
    vk::AttachmentReference { attachment, layout: used.layout() }
}

/// Images bound to a render pass.
pub struct Framebuffer {
    pub(super) raw: vk::Framebuffer,
    pub(super) size: [u32; 2],
    device: Arc<Device>,
}

impl Framebuffer {
    /// Binds images, in the order of the pass's attachments, all of one size.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, pass: &RenderPass, images: &[&Image]) -> Result<Self> {
        let views: Vec<_> = images.iter().map(|image| image.view).collect();
        let size = images.first().map_or([1, 1], |image| image.size);
        let limits = &device.limits;
        let framebuffer = [limits.max_framebuffer_width, limits.max_framebuffer_height];
        let most = [0, 1].map(|axis| framebuffer[axis].min(limits.max_viewport_dimensions[axis]));
        if size[0] > most[0] || size[1] > most[1] {
            let shape = |[width, height]: [u32; 2]| format!("{width} × {height} pixels");
            return Err(too_large("the picture", &shape(size), &shape(most)));
        }
        let info = vk::FramebufferCreateInfo::default()
            .render_pass(pass.raw)
            .attachments(&views)
            .width(size[0])
            .height(size[1])
            .layers(1);
        // SAFETY: formats and sizes fit the pass, as validation checks in tests.
        let raw = unsafe { device.raw.create_framebuffer(&info, None) }.called("vkCreateFramebuffer")?;
        Ok(Self { raw, size, device: device.clone() })
    }
}

impl Drop for Framebuffer {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`.
        unsafe { self.device.raw.destroy_framebuffer(self.raw, None) };
    }
}
