//! A picture on its way into a window: the copy that the host does not wait for.

use super::device::Device;
use super::{Called, Commands, Image};
use crate::error::Result;
use ash::vk;
use std::sync::Arc;

/// How long the host waits for a window, in nanoseconds; a hidden one may keep its images for as long as it is hidden.
pub(super) const PATIENCE: u64 = 100_000_000;

/// Commands of one copy, and what they need until the device has finished with them.
pub(super) struct Flight {
    /// Signalled once the window's image is free to be written.
    pub(super) acquired: vk::Semaphore,
    landed: vk::Fence,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    /// Held until the copy has landed, so that whoever rendered it may drop it at any time.
    picture: Option<Arc<Image>>,
    device: Arc<Device>,
}

impl Flight {
    pub(super) fn new(device: &Arc<Device>) -> Result<Self> {
        let mut flight = Self {
            acquired: device.semaphore().called("vkCreateSemaphore")?,
            landed: vk::Fence::null(),
            pool: vk::CommandPool::null(),
            commands: vk::CommandBuffer::null(),
            picture: None,
            device: device.clone(),
        };
        // SAFETY: the device is alive.
        flight.landed = unsafe { device.raw.create_fence(&vk::FenceCreateInfo::default(), None) }
            .called("vkCreateFence")?;
        flight.pool = device.command_pool()?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(flight.pool).command_buffer_count(1);
        // SAFETY: the pool belongs to the device and to this flight alone.
        flight.commands =
            unsafe { device.raw.allocate_command_buffers(&info) }.called("vkAllocateCommandBuffers")?[0];
        Ok(flight)
    }

    /// Whether the last copy has landed, after waiting for it a little; then the next may be recorded.
    pub(super) fn land(&mut self) -> Result<bool> {
        if self.picture.is_none() {
            return Ok(true);
        }
        // SAFETY: the fence was handed over with the copy.
        match unsafe { self.device.raw.wait_for_fences(&[self.landed], true, PATIENCE) } {
            Err(vk::Result::TIMEOUT) => return Ok(false),
            result => result.called("vkWaitForFences")?,
        }
        self.picture = None;
        // SAFETY: the fence is signalled, and nothing else uses it.
        unsafe { self.device.raw.reset_fences(&[self.landed]) }.called("vkResetFences")?;
        // SAFETY: the pool's only commands have finished.
        unsafe { self.device.raw.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty()) }
            .called("vkResetCommandPool")?;
        Ok(true)
    }

    /// Sends the copy of a picture off, once the window's image is free; signals `copied` when it has landed.
    pub(super) fn depart(
        &mut self,
        picture: &Arc<Image>,
        copied: vk::Semaphore,
        record: impl FnOnce(&mut Commands, &Image),
    ) -> Result<()> {
        Commands::record(&self.device, self.commands, "show", |cmd| {
            record(cmd, picture);
            Ok(())
        })?;
        let (waits, stages) = ([self.acquired], [vk::PipelineStageFlags::TRANSFER]);
        let (commands, signals) = ([self.commands], [copied]);
        let submit = [vk::SubmitInfo::default()
            .wait_semaphores(&waits)
            .wait_dst_stage_mask(&stages)
            .command_buffers(&commands)
            .signal_semaphores(&signals)];
        // SAFETY: the buffer is fully recorded, the fence unsignalled, and this thread has the queue.
        let submit = |queue| unsafe { self.device.raw.queue_submit(queue, &submit, self.landed) };
        self.device.with_queue(submit).called("vkQueueSubmit")?;
        self.picture = Some(picture.clone());
        Ok(())
    }
}

impl Drop for Flight {
    fn drop(&mut self) {
        // SAFETY: the swapchain waits for the queue before it drops its flights.
        unsafe { self.device.raw.destroy_command_pool(self.pool, None) };
        // SAFETY: as above.
        unsafe { self.device.raw.destroy_fence(self.landed, None) };
        // SAFETY: as above.
        unsafe { self.device.raw.destroy_semaphore(self.acquired, None) };
    }
}
