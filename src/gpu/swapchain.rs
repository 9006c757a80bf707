//! The images of a window.
//!
//! Host and device take turns, as everywhere in amas: a picture is finished before an image is acquired, and copied
//! before it is presented. A fence for the first and [`Device::run`] for the second make semaphores unnecessary.

use super::device::Device;
use super::surface::{Surface, composite_alpha, extent, image_count};
use super::{Called, Image, Use, failed};
use crate::error::Result;
use ash::{khr, vk};
use std::sync::Arc;

/// How long to wait for a free image, in nanoseconds; a hidden window may have none for as long as it is hidden.
const PATIENCE: u64 = 100_000_000;

/// What became of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// On screen.
    Yes,
    /// On screen, but the images no longer fit the window: resize them before the next picture.
    Misfit,
    /// Not on screen, because the images no longer fit the window: resize them first.
    OutOfDate,
    /// Not on screen, because the window keeps all images: show it again later.
    Busy,
}

/// The images of a window, in FIFO order: no tearing, at most one picture per refresh of the display.
pub struct Swapchain {
    // Null until the window has an area.
    raw: vk::SwapchainKHR,
    images: Vec<vk::Image>,
    size: [u32; 2],
    // Signalled once an image is free to be written.
    free: vk::Fence,
    loader: khr::swapchain::Device,
    surface: Surface,
    device: Arc<Device>,
}

impl Swapchain {
    /// A swapchain of the device that was opened for the surface, without images; [`Swapchain::resize`] makes them.
    pub(super) fn new(device: &Arc<Device>, surface: Surface) -> Result<Self> {
        // SAFETY: the device is alive.
        let free = unsafe { device.raw.create_fence(&vk::FenceCreateInfo::default(), None) }
            .called("vkCreateFence")?;
        Ok(Self {
            raw: vk::SwapchainKHR::null(),
            images: Vec::new(),
            size: [0; 2],
            free,
            loader: device.swapchain_loader(),
            surface,
            device: device.clone(),
        })
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Makes the images anew for a window of that size; `false` where the window has no area now.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn resize(&mut self, window: [u32; 2]) -> Result<bool> {
        let capabilities = self.surface.capabilities(self.device.physical)?;
        let size = extent(&capabilities, window);
        if size.contains(&0) {
            return Ok(false);
        }
        let Some(format) = self.surface.format(self.device.physical)? else {
            return Err(failed("the window's images", vk::Result::ERROR_FORMAT_NOT_SUPPORTED));
        };
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(self.surface.raw)
            .min_image_count(image_count(&capabilities))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(vk::Extent2D { width: size[0], height: size[1] })
            .image_array_layers(1)
            .image_usage(vk::ImageUsageFlags::TRANSFER_DST)
            .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(composite_alpha(&capabilities))
            .present_mode(vk::PresentModeKHR::FIFO)
            .clipped(true)
            .old_swapchain(self.raw);
        // SAFETY: every value is one that the surface offers; the old swapchain is alive, and replaced only here.
        let raw = unsafe { self.loader.create_swapchain(&info, None) }.called("vkCreateSwapchainKHR")?;
        self.destroy();
        self.images.clear();
        self.raw = raw;
        self.size = size;
        // SAFETY: the swapchain is alive.
        self.images = unsafe { self.loader.get_swapchain_images(raw) }.called("vkGetSwapchainImagesKHR")?;
        self.device.name(raw, "window");
        Ok(true)
    }

    /// Copies a picture in use [`Use::TransferRead`] to the window.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn show(&mut self, picture: &Image) -> Result<Shown> {
        if self.images.is_empty() {
            return Ok(Shown::OutOfDate);
        }
        // SAFETY: the fence is unsignalled, and no other image is held: each is presented before the next is acquired.
        let acquired =
            unsafe { self.loader.acquire_next_image(self.raw, PATIENCE, vk::Semaphore::null(), self.free) };
        let (index, misfit) = match acquired {
            Ok(acquired) => acquired,
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => return Ok(Shown::OutOfDate),
            Err(vk::Result::TIMEOUT | vk::Result::NOT_READY) => return Ok(Shown::Busy),
            Err(result) => return Err(failed("vkAcquireNextImageKHR", result)),
        };
        self.wait_until_free()?;
        self.copy(picture, self.images[index as usize])?;
        Ok(match self.present(index)? {
            Shown::Yes if misfit => Shown::Misfit,
            shown => shown,
        })
    }

    fn wait_until_free(&self) -> Result<()> {
        let fences = [self.free];
        // SAFETY: the acquisition signals the fence.
        unsafe { self.device.raw.wait_for_fences(&fences, true, u64::MAX) }.called("vkWaitForFences")?;
        // SAFETY: the fence is signalled, and nothing else uses it.
        unsafe { self.device.raw.reset_fences(&fences) }.called("vkResetFences")
    }

    fn copy(&self, picture: &Image, target: vk::Image) -> Result<()> {
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let range = vk::ImageSubresourceRange {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            base_mip_level: 0,
            level_count: 1,
            base_array_layer: 0,
            layer_count: 1,
        };
        // A blit, because it swaps red and blue where the formats differ.
        let region = vk::ImageBlit {
            src_subresource: layers,
            src_offsets: corners(picture.size),
            dst_subresource: layers,
            dst_offsets: corners(self.size),
        };
        self.device.run("show", |cmd| {
            cmd.transition_raw((target, range), Use::Nothing, Use::TransferWrite);
            // SAFETY: both images are alive and in these layouts, and the regions are all of them.
            unsafe {
                self.device.raw.cmd_blit_image(
                    cmd.raw,
                    picture.raw,
                    vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                    target,
                    vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                    &[region],
                    vk::Filter::NEAREST,
                );
            };
            cmd.transition_raw((target, range), Use::TransferWrite, Use::Present);
            Ok(())
        })
    }

    fn present(&self, index: u32) -> Result<Shown> {
        let (swapchains, indices) = ([self.raw], [index]);
        let info = vk::PresentInfoKHR::default().swapchains(&swapchains).image_indices(&indices);
        // SAFETY: the image was acquired, its copy was waited for, and this thread has the queue.
        let presented = self.device.with_queue(|queue| unsafe { self.loader.queue_present(queue, &info) });
        match presented {
            Ok(false) => Ok(Shown::Yes),
            Ok(true) => Ok(Shown::Misfit),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(Shown::OutOfDate),
            Err(result) => Err(failed("vkQueuePresentKHR", result)),
        }
    }

    fn destroy(&self) {
        // SAFETY: this thread has the queue. A device that is lost has nothing pending either.
        let _ = self.device.with_queue(|queue| unsafe { self.device.raw.queue_wait_idle(queue) });
        // SAFETY: nothing is pending on the images; a null swapchain is allowed.
        unsafe { self.loader.destroy_swapchain(self.raw, None) };
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        self.destroy();
        // SAFETY: every acquisition was waited for. The fields follow: the surface first, then the device.
        unsafe { self.device.raw.destroy_fence(self.free, None) };
    }
}

fn corners(size: [u32; 2]) -> [vk::Offset3D; 2] {
    let [x, y] = size.map(|side| i32::try_from(side).unwrap_or(i32::MAX));
    [vk::Offset3D::default(), vk::Offset3D { x, y, z: 1 }]
}
