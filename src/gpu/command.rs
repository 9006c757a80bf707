//! Recording.

use super::barrier;
use super::descriptor::{DescriptorSet, PUSH_BYTES};
use super::device::Device;
use super::pipeline::{ComputePipeline, GraphicsPipeline};
use super::render_pass::{Framebuffer, RenderPass};
use super::{Buffer, Called, Use};
use crate::error::Result;
use ash::vk;
use bytemuck::Pod;
use std::sync::Arc;

/// A command buffer being recorded; made by [`Device::run`].
pub struct Commands {
    pub(super) raw: vk::CommandBuffer,
    pub(super) device: Arc<Device>,
    layout: vk::PipelineLayout,
    point: vk::PipelineBindPoint,
}

impl Commands {
    pub(super) fn record<T>(
        device: &Arc<Device>,
        raw: vk::CommandBuffer,
        name: &str,
        record: impl FnOnce(&mut Self) -> Result<T>,
    ) -> Result<T> {
        device.name(raw, name);
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the buffer is fresh from its pool.
        unsafe { device.raw.begin_command_buffer(raw, &begin) }.called("vkBeginCommandBuffer")?;
        let mut commands = Self {
            raw,
            device: device.clone(),
            layout: vk::PipelineLayout::null(),
            point: vk::PipelineBindPoint::GRAPHICS,
        };
        let value = record(&mut commands)?;
        // SAFETY: recording was begun above.
        unsafe { device.raw.end_command_buffer(raw) }.called("vkEndCommandBuffer")?;
        Ok(value)
    }

    /// Records `body` under a debug label.
    pub fn labelled(&mut self, name: &str, body: impl FnOnce(&mut Self)) {
        let label = std::ffi::CString::new(name).unwrap_or_default();
        let info = vk::DebugUtilsLabelEXT::default().label_name(&label);
        if let Some(debug) = &self.device.debug {
            // SAFETY: the label outlives the call.
            unsafe { debug.cmd_begin_debug_utils_label(self.raw, &info) };
        }
        body(self);
        if let Some(debug) = &self.device.debug {
            // SAFETY: closes the label opened above.
            unsafe { debug.cmd_end_debug_utils_label(self.raw) };
        }
    }

    /// A barrier over all buffers: what `before` wrote, `after` sees.
    pub fn memory_barrier(&mut self, before: Use, after: Use) {
        // SAFETY: the scopes come from the table of uses.
        unsafe {
            self.device.raw.cmd_pipeline_barrier(
                self.raw,
                before.scope().0,
                after.scope().0,
                vk::DependencyFlags::empty(),
                &[barrier::memory(before, after)],
                &[],
                &[],
            );
        };
    }

    /// Makes all that was written visible to whatever is submitted later: having waited for it does not.
    pub(super) fn visible_to_all(&mut self) {
        let all = vk::PipelineStageFlags::ALL_COMMANDS;
        let barrier = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE);
        let (raw, none) = (self.raw, vk::DependencyFlags::empty());
        // SAFETY: outside of a render pass, as recording ends there.
        unsafe { self.device.raw.cmd_pipeline_barrier(raw, all, all, none, &[barrier], &[], &[]) };
    }

    /// Binds a compute pipeline and its sets, from set 0.
    pub fn bind_compute(&mut self, pipeline: &ComputePipeline, sets: &[DescriptorSet<'_>]) {
        self.point = vk::PipelineBindPoint::COMPUTE;
        self.layout = pipeline.layout.raw;
        // SAFETY: the pipeline is alive until the work is waited for.
        unsafe { self.device.raw.cmd_bind_pipeline(self.raw, self.point, pipeline.raw.pipeline) };
        self.bind_sets(0, sets);
    }

    /// Binds a graphics pipeline; its sets stay as bound.
    pub fn bind_graphics(&mut self, pipeline: &GraphicsPipeline) {
        self.point = vk::PipelineBindPoint::GRAPHICS;
        self.layout = pipeline.layout.raw;
        // SAFETY: as for compute.
        unsafe { self.device.raw.cmd_bind_pipeline(self.raw, self.point, pipeline.raw.pipeline) };
    }

    /// Binds sets from number `first` on, for the pipeline bound last.
    pub fn bind_sets(&mut self, first: u32, sets: &[DescriptorSet<'_>]) {
        let raws: Vec<_> = sets.iter().map(|set| set.raw).collect();
        // SAFETY: the sets were made with the layout's tables.
        unsafe {
            self.device.raw.cmd_bind_descriptor_sets(self.raw, self.point, self.layout, first, &raws, &[])
        };
    }

    /// Sets push constants from offset 0.
    pub fn push<T: Pod>(&mut self, constants: &T) {
        let bytes = bytemuck::bytes_of(constants);
        debug_assert!(bytes.len() <= PUSH_BYTES as usize, "push constants are at most 128 bytes");
        let stages =
            vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT | vk::ShaderStageFlags::COMPUTE;
        // SAFETY: every pipeline layout has 128 bytes for these stages.
        unsafe { self.device.raw.cmd_push_constants(self.raw, self.layout, stages, 0, bytes) };
    }

    /// Dispatches workgroups.
    pub fn dispatch(&mut self, groups: [u32; 3]) {
        // SAFETY: a compute pipeline and its sets are bound.
        unsafe { self.device.raw.cmd_dispatch(self.raw, groups[0], groups[1], groups[2]) };
    }

    /// Dispatches as many workgroups as the buffer's three words from number `word` on say.
    pub fn dispatch_indirect<T: Pod>(&mut self, arguments: &Buffer<T>, word: u32) {
        // SAFETY: the buffer has three words there, as its shared struct says.
        unsafe { self.device.raw.cmd_dispatch_indirect(self.raw, arguments.raw, 4 * u64::from(word)) };
    }

    /// Dispatches as many workgroups as the three words at a byte offset say.
    pub fn dispatch_indirect_at<T: Pod>(&mut self, arguments: &Buffer<T>, offset: usize) {
        // SAFETY: the caller's shared struct begins with three words at that offset.
        unsafe {
            self.device.raw.cmd_dispatch_indirect(self.raw, arguments.raw, offset as vk::DeviceSize);
        };
    }

    /// Binds vertices and indices.
    pub fn bind_triangles<V: Pod>(&mut self, vertices: &Buffer<V>, triangles: &Buffer<[u32; 3]>) {
        // SAFETY: the buffers are alive until the work is waited for.
        unsafe { self.device.raw.cmd_bind_vertex_buffers(self.raw, 0, &[vertices.raw], &[0]) };
        // SAFETY: as above.
        unsafe { self.device.raw.cmd_bind_index_buffer(self.raw, triangles.raw, 0, vk::IndexType::UINT32) };
    }

    /// Draws triangles `first..first + count` of the bound ones.
    pub fn draw_triangles(&mut self, first: u32, count: u32) {
        // SAFETY: the range lies in the index buffer, as the scene's draws say.
        unsafe { self.device.raw.cmd_draw_indexed(self.raw, 3 * count, 1, 3 * first, 0, 0) };
    }

    /// Keeps what follows within a rectangle of the target: its corner, and its size.
    pub fn clip(&mut self, [x, y]: [u32; 2], [width, height]: [u32; 2]) {
        let area = vk::Rect2D {
            offset: vk::Offset2D { x: x as i32, y: y as i32 },
            extent: vk::Extent2D { width, height },
        };
        // SAFETY: the scissor is dynamic in every pipeline; offsets below 2³¹ are not negative.
        unsafe { self.device.raw.cmd_set_scissor(self.raw, 0, &[area]) };
    }

    /// Draws one triangle over the whole target.
    pub fn draw_fullscreen(&mut self) {
        // SAFETY: the bound pipeline reads no vertices.
        unsafe { self.device.raw.cmd_draw(self.raw, 3, 1, 0, 0) };
    }

    /// Begins a render pass over a whole framebuffer; every fresh attachment is cleared to 0.
    pub fn begin_pass(&mut self, pass: &RenderPass, framebuffer: &Framebuffer) {
        // Zero is black, no surface, and the far plane of reversed depth.
        let clears = [vk::ClearValue::default(); 8];
        let area = vk::Rect2D {
            offset: vk::Offset2D::default(),
            extent: vk::Extent2D { width: framebuffer.size[0], height: framebuffer.size[1] },
        };
        let info = vk::RenderPassBeginInfo::default()
            .render_pass(pass.raw)
            .framebuffer(framebuffer.raw)
            .render_area(area)
            .clear_values(&clears);
        // SAFETY: pass and framebuffer are alive and compatible.
        unsafe { self.device.raw.cmd_begin_render_pass(self.raw, &info, vk::SubpassContents::INLINE) };
        let [width, height] = framebuffer.size.map(|side| side as f32);
        let viewport = vk::Viewport { x: 0.0, y: 0.0, width, height, min_depth: 0.0, max_depth: 1.0 };
        // SAFETY: viewport and scissor are dynamic in every pipeline.
        unsafe { self.device.raw.cmd_set_viewport(self.raw, 0, &[viewport]) };
        // SAFETY: as above.
        unsafe { self.device.raw.cmd_set_scissor(self.raw, 0, &[area]) };
    }

    /// Goes on to the next subpass.
    pub fn next_subpass(&mut self) {
        // SAFETY: inside a render pass with a further subpass.
        unsafe { self.device.raw.cmd_next_subpass(self.raw, vk::SubpassContents::INLINE) };
    }

    /// Ends the render pass.
    pub fn end_pass(&mut self) {
        // SAFETY: inside the last subpass.
        unsafe { self.device.raw.cmd_end_render_pass(self.raw) };
    }
}
