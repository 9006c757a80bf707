//! The images of a window.
//!
//! Two pictures may be on their way at once: while the device copies one and the window takes it, the host records the
//! next. Rendering a picture anew waits on the device for copies of the one before: the copy was submitted earlier, and the
//! subpass that overwrites the picture depends on [`Use::TransferRead`] outside of its pass.

use super::device::Device;
use super::flight::{Flight, PATIENCE};
use super::surface::{Surface, composite_alpha, extent, image_count};
use super::{Called, Commands, Image, Use, failed};
use crate::error::Result;
use crate::scene::settings::Encoding;
use ash::{khr, vk};
use std::sync::Arc;

/// Pictures on their way at once.
const FLIGHTS: usize = 2;

/// What became of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// On its way to the screen.
    Yes,
    /// On its way, but the images no longer fit the window: resize them before the next picture.
    Misfit,
    /// Not shown, because the images no longer fit the window: resize them first.
    OutOfDate,
    /// Not shown, because the window keeps all images: show it again later.
    Busy,
}

/// The images of a window.
pub struct Swapchain {
    // Null until the window has an area.
    raw: vk::SwapchainKHR,
    images: Vec<vk::Image>,
    // By image: signalled once it holds the picture.
    copied: Vec<vk::Semaphore>,
    size: [u32; 2],
    transform: vk::SurfaceTransformFlagsKHR,
    vsync: bool,
    // Whether a format of high dynamic range is wanted.
    high: bool,
    encoding: Encoding,
    // The surface is gone, and is made again before the next images.
    lost: bool,
    flights: [Flight; FLIGHTS],
    next: usize,
    loader: khr::swapchain::Device,
    surface: Surface,
    device: Arc<Device>,
}

impl Swapchain {
    /// A swapchain of the device that was opened for the surface, without images; [`Swapchain::resize`] makes them.
    pub(super) fn new(device: &Arc<Device>, surface: Surface, high: bool) -> Result<Self> {
        let format = surface.format(device.physical, high).called("vkGetPhysicalDeviceSurfaceFormatsKHR")?;
        Ok(Self {
            high,
            // Without a format nothing is ever shown: `make` fails.
            encoding: format.map_or(Encoding::Srgb, |(_, encoding)| encoding),
            raw: vk::SwapchainKHR::null(),
            images: Vec::new(),
            copied: Vec::new(),
            size: [0; 2],
            transform: vk::SurfaceTransformFlagsKHR::IDENTITY,
            vsync: true,
            lost: false,
            flights: [Flight::new(device)?, Flight::new(device)?],
            next: 0,
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

    /// How pictures for it are to be encoded.
    #[must_use]
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// Whether pictures wait for the display's refresh; from the next [`Swapchain::resize`] on.
    pub fn set_vsync(&mut self, vsync: bool) {
        self.vsync = vsync;
    }

    /// Lets the window's surface go; the next [`Swapchain::resize`] makes it again.
    pub fn suspend(&mut self) {
        self.destroy();
        self.lost = true;
    }

    /// Makes the images anew for a window of that size; `false` where the window has no area now.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver; [`crate::Error::NoDevice`] where the window was lost and has come back to another device.
    pub fn resize(&mut self, window: [u32; 2]) -> Result<bool> {
        if self.lost {
            self.destroy();
            self.surface = self.surface.again(&self.device)?;
            self.lost = false;
        }
        let made = self.make(window);
        self.lost = matches!(made, Err(vk::Result::ERROR_SURFACE_LOST_KHR));
        match made {
            // Found again, or not, when the next picture is to be shown.
            Err(vk::Result::ERROR_SURFACE_LOST_KHR) => Ok(false),
            Err(result) => Err(failed("the window's images", result)),
            Ok(made) => Ok(made),
        }
    }

    fn make(&mut self, window: [u32; 2]) -> Result<bool, vk::Result> {
        let physical = self.device.physical;
        let capabilities = self.surface.capabilities(physical)?;
        let size = extent(&capabilities, window);
        if size.contains(&0) {
            return Ok(false);
        }
        let format = self.surface.format(physical, self.high)?;
        let (format, encoding) = format.ok_or(vk::Result::ERROR_FORMAT_NOT_SUPPORTED)?;
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
            .present_mode(self.surface.present_mode(physical, self.vsync)?)
            .clipped(true)
            .old_swapchain(self.raw);
        // SAFETY: every value is one that the surface offers; the old swapchain is alive, and replaced only here.
        let raw = unsafe { self.loader.create_swapchain(&info, None) }?;
        self.destroy();
        self.raw = raw;
        self.size = size;
        self.transform = capabilities.current_transform;
        self.encoding = encoding;
        // SAFETY: the swapchain is alive.
        self.images = unsafe { self.loader.get_swapchain_images(raw) }?;
        for _ in &self.images {
            self.copied.push(self.device.semaphore()?);
        }
        self.device.name(raw, "window");
        Ok(true)
    }

    /// Sends a picture, in use [`Use::TransferRead`], to the window. It may be rendered anew right away, and dropped. Calls
    /// `presenting` when nothing is left but to tell the window.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn show(&mut self, picture: &Arc<Image>, presenting: impl FnOnce()) -> Result<Shown> {
        if self.images.is_empty() {
            return Ok(Shown::OutOfDate);
        }
        if !self.flights[self.next].land()? {
            return Ok(Shown::Busy);
        }
        let free = self.flights[self.next].acquired;
        // SAFETY: the semaphore is unsignalled, because the copy that waited for it has landed.
        let acquired = unsafe { self.loader.acquire_next_image(self.raw, PATIENCE, free, vk::Fence::null()) };
        let (index, misfit) = match acquired {
            Ok(acquired) => acquired,
            Err(vk::Result::TIMEOUT | vk::Result::NOT_READY) => return Ok(Shown::Busy),
            Err(result) => return self.out_of_date("vkAcquireNextImageKHR", result),
        };
        self.copy(picture, index as usize)?;
        self.next = (self.next + 1) % FLIGHTS;
        presenting();
        Ok(match self.present(index)? {
            Shown::Yes if misfit => self.misfit(),
            Shown::Misfit => self.misfit(),
            shown => shown,
        })
    }

    /// What it means that a picture could be shown better: nothing where images made anew would be the same, as some drivers
    /// say so of every picture.
    fn misfit(&self) -> Shown {
        let same = |found: vk::SurfaceCapabilitiesKHR| {
            extent(&found, self.size) == self.size && found.current_transform == self.transform
        };
        if self.surface.capabilities(self.device.physical).is_ok_and(same) {
            Shown::Yes
        } else {
            Shown::Misfit
        }
    }

    fn copy(&mut self, picture: &Arc<Image>, index: usize) -> Result<()> {
        let (target, size, copied) = (self.images[index], self.size, self.copied[index]);
        self.flights[self.next].depart(picture, copied, |cmd, picture| blit(cmd, picture, target, size))
    }

    fn present(&mut self, index: u32) -> Result<Shown> {
        let (swapchains, indices, waits) = ([self.raw], [index], [self.copied[index as usize]]);
        let info = vk::PresentInfoKHR::default()
            .wait_semaphores(&waits)
            .swapchains(&swapchains)
            .image_indices(&indices);
        // SAFETY: the image was acquired, its copy signals the semaphore, and this thread has the queue.
        let presented = self.device.with_queue(|queue| unsafe { self.loader.queue_present(queue, &info) });
        match presented {
            Ok(false) => Ok(Shown::Yes),
            Ok(true) => Ok(Shown::Misfit),
            Err(result) => self.out_of_date("vkQueuePresentKHR", result),
        }
    }

    /// What a failed call means for the window.
    fn out_of_date(&mut self, call: &str, result: vk::Result) -> Result<Shown> {
        match result {
            vk::Result::ERROR_OUT_OF_DATE_KHR => Ok(Shown::OutOfDate),
            vk::Result::ERROR_SURFACE_LOST_KHR => {
                self.lost = true;
                Ok(Shown::OutOfDate)
            }
            _ => Err(failed(call, result)),
        }
    }

    fn destroy(&mut self) {
        // SAFETY: this thread has the queue. A device that is lost has nothing pending either.
        let _ = self.device.with_queue(|queue| unsafe { self.device.raw.queue_wait_idle(queue) });
        for copied in self.copied.drain(..) {
            // SAFETY: nothing is pending on it.
            unsafe { self.device.raw.destroy_semaphore(copied, None) };
        }
        self.images.clear();
        // SAFETY: nothing is pending on the images; a null swapchain is allowed.
        unsafe { self.loader.destroy_swapchain(self.raw, None) };
        self.raw = vk::SwapchainKHR::null();
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        // The fields follow: flights, which nothing waits for now, the surface, then the device.
        self.destroy();
    }
}

/// A blit, because it swaps red and blue where the formats differ.
fn blit(cmd: &mut Commands, picture: &Image, target: vk::Image, size: [u32; 2]) {
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
    let region = vk::ImageBlit {
        src_subresource: layers,
        src_offsets: corners(picture.size),
        dst_subresource: layers,
        dst_offsets: corners(size),
    };
    cmd.transition_raw((target, range), Use::Acquired, Use::TransferWrite);
    // SAFETY: both images are alive and in these layouts, and the regions are all of them.
    unsafe {
        cmd.device.raw.cmd_blit_image(
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
}

fn corners(size: [u32; 2]) -> [vk::Offset3D; 2] {
    let [x, y] = size.map(|side| i32::try_from(side).unwrap_or(i32::MAX));
    [vk::Offset3D::default(), vk::Offset3D { x, y, z: 1 }]
}
