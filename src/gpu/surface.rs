//! A window's surface, and the device that presents to it.

use super::Called;
use super::candidate::Presentation;
use super::device::{Device, Options};
use super::instance::{Instance, has};
use super::requirements::Check;
use super::swapchain::Swapchain;
use crate::error::{Error, Result};
use crate::scene::settings::Encoding;
use ash::{khr, vk};
use std::ffi::CStr;
use std::path::PathBuf;
use std::sync::Arc;
use winit::event_loop::OwnedDisplayHandle;
use winit::raw_window_handle::{HandleError, HasDisplayHandle, HasWindowHandle, RawDisplayHandle};
use winit::window::Window;

type Offer = (vk::Format, vk::ColorSpaceKHR, Encoding);

/// Not the sRGB formats: the present pass has encoded the picture already.
const STANDARD: [Offer; 2] = [
    (vk::Format::B8G8R8A8_UNORM, vk::ColorSpaceKHR::SRGB_NONLINEAR, Encoding::Srgb),
    (vk::Format::R8G8B8A8_UNORM, vk::ColorSpaceKHR::SRGB_NONLINEAR, Encoding::Srgb),
];

/// High dynamic range, in order of preference.
const HIGH: [Offer; 3] = [
    (vk::Format::R16G16B16A16_SFLOAT, vk::ColorSpaceKHR::EXTENDED_SRGB_LINEAR_EXT, Encoding::ScRgb),
    (vk::Format::A2B10G10R10_UNORM_PACK32, vk::ColorSpaceKHR::HDR10_ST2084_EXT, Encoding::Hdr10),
    (vk::Format::A2R10G10B10_UNORM_PACK32, vk::ColorSpaceKHR::HDR10_ST2084_EXT, Encoding::Hdr10),
];

/// What a window asks for beyond a device.
#[derive(Clone, Debug, Default)]
pub struct WindowOptions {
    /// High dynamic range, where the window offers it.
    pub high: bool,
    /// Folder in which compiled pipelines are kept.
    pub cache: Option<PathBuf>,
}

/// Where a window's pictures go.
pub(super) struct Surface {
    pub(super) raw: vk::SurfaceKHR,
    pub(super) loader: khr::surface::Instance,
    // The surface is destroyed before these three, which it was made from.
    instance: Arc<Instance>,
    window: Arc<Window>,
    display: OwnedDisplayHandle,
    wayland: bool,
}

impl Device {
    /// Opens a device that can present to the window, and the window's swapchain, still without images.
    ///
    /// # Errors
    /// [`Error::NoDevice`] as [`Device::open`], and where no device can present to the window.
    pub fn open_for_window(
        options: &Options,
        window: &Arc<Window>,
        display: OwnedDisplayHandle,
        wanted: &WindowOptions,
    ) -> Result<(Arc<Self>, Swapchain)> {
        let raw = display.display_handle().map_err(no_handle)?.as_raw();
        let instance = Instance::for_window(options.validate, &required_extensions(raw)?)?;
        let surface = Surface::new(instance.clone(), window.clone(), display)?;
        let device = Self::open_on(instance, options, Some(&surface), wanted.cache.as_deref())?;
        let swapchain = Swapchain::new(&device, surface, wanted.high)?;
        Ok((device, swapchain))
    }
}

impl Surface {
    fn new(instance: Arc<Instance>, window: Arc<Window>, display: OwnedDisplayHandle) -> Result<Self> {
        let display_handle = display.display_handle().map_err(no_handle)?.as_raw();
        let window_handle = window.window_handle().map_err(no_handle)?.as_raw();
        // SAFETY: the instance has the display's surface extensions. `self` holds instance, window and display, and
        // `Drop` destroys the surface before it lets go of them.
        let raw = unsafe {
            ash_window::create_surface(&instance.entry, &instance.raw, display_handle, window_handle, None)
        }
        .called("the window's surface")?;
        Ok(Self {
            raw,
            loader: khr::surface::Instance::new(&instance.entry, &instance.raw),
            instance,
            wayland: matches!(display_handle, RawDisplayHandle::Wayland(_)),
            window,
            display,
        })
    }

    /// A format that the present pass's values can be shown in, and how it encodes them: with `high` one of high dynamic range
    /// where there is one, else sRGB. `None` where there is neither.
    pub(super) fn format(
        &self,
        physical: vk::PhysicalDevice,
        high: bool,
    ) -> Result<Option<(vk::SurfaceFormatKHR, Encoding)>, vk::Result> {
        // SAFETY: the device presents to the surface.
        let mut found = unsafe { self.loader.get_physical_device_surface_formats(physical, self.raw) }?;
        // Pictures are copied there by a blit, of which not every device is capable for those with ten bits.
        found.retain(|offer| self.instance.blits_to(physical, offer.format));
        Ok(format(&found, high))
    }

    pub(super) fn capabilities(
        &self,
        physical: vk::PhysicalDevice,
    ) -> Result<vk::SurfaceCapabilitiesKHR, vk::Result> {
        // SAFETY: the device presents to the surface.
        unsafe { self.loader.get_physical_device_surface_capabilities(physical, self.raw) }
    }

    /// How pictures follow one another: with `vsync` at the display's refresh, else as soon as they are there.
    pub(super) fn present_mode(
        &self,
        physical: vk::PhysicalDevice,
        vsync: bool,
    ) -> Result<vk::PresentModeKHR, vk::Result> {
        // SAFETY: the device presents to the surface.
        let offered = unsafe { self.loader.get_physical_device_surface_present_modes(physical, self.raw) }?;
        Ok(present_mode(&offered, vsync, self.wayland))
    }

    /// The surface of the same window once more, after it was lost.
    pub(super) fn again(&self, device: &Device) -> Result<Self> {
        let surface = Self::new(self.instance.clone(), self.window.clone(), self.display.clone())?;
        if surface.presents(device.physical, device.family) {
            return Ok(surface);
        }
        Err(Error::NoDevice {
            cause: format!("the window was lost, and {} does not present to it any more", device.info().name),
            remedy: "start amas again".into(),
        })
    }

    fn has_swapchains(&self, physical: vk::PhysicalDevice) -> bool {
        // SAFETY: the device belongs to the instance.
        let found = unsafe { self.instance.raw.enumerate_device_extension_properties(physical) };
        found.is_ok_and(|found| has(&found, khr::swapchain::NAME))
    }

    fn takes_copies(&self, physical: vk::PhysicalDevice) -> bool {
        self.capabilities(physical)
            .is_ok_and(|found| found.supported_usage_flags.contains(vk::ImageUsageFlags::TRANSFER_DST))
    }
}

impl Presentation for Surface {
    fn presents(&self, physical: vk::PhysicalDevice, family: u32) -> bool {
        // SAFETY: device and surface belong to the instance, and the device has the family.
        let answer = unsafe { self.loader.get_physical_device_surface_support(physical, family, self.raw) };
        answer.unwrap_or(false)
    }

    fn checks(&self, physical: vk::PhysicalDevice, family: Option<u32>) -> Vec<Check> {
        let row = |name: &str, ok| Check {
            name: name.into(),
            found: if ok { "it" } else { "none" }.into(),
            why: "pictures in a window",
            ok,
        };
        // A device that does not present must not be asked for the surface's properties.
        let mut rows = vec![row("a queue that presents to the window", family.is_some())];
        if family.is_some() {
            rows.extend([
                row("VK_KHR_swapchain", self.has_swapchains(physical)),
                row("a surface with 8-bit UNORM colour", matches!(self.format(physical, false), Ok(Some(_)))),
                row("a surface that can be copied to", self.takes_copies(physical)),
            ]);
        }
        rows
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: the swapchain holds the surface, and is gone; instance, window and display are still held.
        unsafe { self.loader.destroy_surface(self.raw, None) };
    }
}

fn format(offered: &[vk::SurfaceFormatKHR], high: bool) -> Option<(vk::SurfaceFormatKHR, Encoding)> {
    let wanted = if high { &HIGH[..] } else { &[] };
    wanted.iter().chain(&STANDARD).find_map(|&(format, color_space, encoding)| {
        let wanted = vk::SurfaceFormatKHR { format, color_space };
        offered.contains(&wanted).then_some((wanted, encoding))
    })
}

fn required_extensions(display: RawDisplayHandle) -> Result<Vec<&'static CStr>> {
    let names = ash_window::enumerate_required_extensions(display)
        .map_err(|_| no_surface("amas knows no surface extension for this display"))?;
    Ok(names
        .iter()
        // SAFETY: the names are terminated strings in static memory.
        .map(|&name| unsafe { CStr::from_ptr(name) })
        .collect())
}

fn no_handle(error: HandleError) -> Error {
    no_surface(&format!("the window has no handle ({error})"))
}

fn no_surface(cause: &str) -> Error {
    Error::NoDevice { cause: cause.into(), remedy: "open the window on X11 or Wayland".into() }
}

/// The window's size where the surface knows it, else the size asked for, within what the surface allows.
pub(super) fn extent(capabilities: &vk::SurfaceCapabilitiesKHR, window: [u32; 2]) -> [u32; 2] {
    let [now, least, most] =
        [capabilities.current_extent, capabilities.min_image_extent, capabilities.max_image_extent]
            .map(|extent| [extent.width, extent.height]);
    if now == [u32::MAX; 2] {
        // A minimised window stays without an area.
        [0, 1].map(|i| match window[i] {
            0 => 0,
            side => side.max(least[i]).min(most[i]),
        })
    } else {
        now
    }
}

/// One more than the least, so that the window need not give one back before the next is acquired.
pub(super) fn image_count(capabilities: &vk::SurfaceCapabilitiesKHR) -> u32 {
    let wanted = capabilities.min_image_count.saturating_add(1);
    match capabilities.max_image_count {
        0 => wanted,
        most => wanted.min(most),
    }
}

/// On Wayland, pictures wait for the window's frame events before they are rendered. There FIFO would wait once more, in the
/// driver, and for as long as the window is hidden.
fn present_mode(offered: &[vk::PresentModeKHR], vsync: bool, wayland: bool) -> vk::PresentModeKHR {
    use vk::PresentModeKHR as Mode;
    let wanted: &[Mode] = match (vsync, wayland) {
        (true, false) => &[],
        (_, true) => &[Mode::MAILBOX],
        (false, false) => &[Mode::MAILBOX, Mode::IMMEDIATE],
    };
    // FIFO is everywhere.
    wanted.iter().copied().find(|mode| offered.contains(mode)).unwrap_or(Mode::FIFO)
}

/// Opaque where the surface can; otherwise whatever it does.
pub(super) fn composite_alpha(capabilities: &vk::SurfaceCapabilitiesKHR) -> vk::CompositeAlphaFlagsKHR {
    use vk::CompositeAlphaFlagsKHR as Alpha;
    [Alpha::OPAQUE, Alpha::INHERIT, Alpha::POST_MULTIPLIED, Alpha::PRE_MULTIPLIED]
        .into_iter()
        .find(|&alpha| capabilities.supported_composite_alpha.contains(alpha))
        .unwrap_or(Alpha::OPAQUE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn capabilities(current: u32) -> vk::SurfaceCapabilitiesKHR {
        let square = |side| vk::Extent2D { width: side, height: side };
        vk::SurfaceCapabilitiesKHR {
            min_image_count: 3,
            max_image_count: 3,
            current_extent: square(current),
            min_image_extent: square(16),
            max_image_extent: square(4096),
            supported_composite_alpha: vk::CompositeAlphaFlagsKHR::INHERIT,
            ..vk::SurfaceCapabilitiesKHR::default()
        }
    }

    #[test]
    fn the_surface_decides_its_size_where_it_has_one() {
        assert_eq!(extent(&capabilities(640), [1, 1]), [640; 2]);
        assert_eq!(extent(&capabilities(u32::MAX), [1, 9999]), [16, 4096]);
        assert_eq!(extent(&capabilities(u32::MAX), [0, 480]), [0, 480]);
    }

    #[test]
    fn only_what_the_surface_offers_is_asked_for() {
        assert_eq!(image_count(&capabilities(640)), 3);
        let alpha = composite_alpha(&capabilities(640));
        assert_eq!(alpha, vk::CompositeAlphaFlagsKHR::INHERIT);
    }

    #[test]
    fn high_dynamic_range_is_taken_where_it_is_asked_for_and_offered() {
        let [standard, high, hdr10] = [STANDARD[1], HIGH[0], HIGH[2]]
            .map(|(format, color_space, _)| vk::SurfaceFormatKHR { format, color_space });
        assert_eq!(format(&[hdr10, standard, high], true), Some((high, Encoding::ScRgb)));
        assert_eq!(format(&[standard, hdr10], true), Some((hdr10, Encoding::Hdr10)));
        assert_eq!(format(&[standard], true), Some((standard, Encoding::Srgb)));
        assert_eq!(format(&[hdr10, high, standard], false), Some((standard, Encoding::Srgb)));
        assert_eq!(format(&[hdr10], false), None);
    }

    #[test]
    fn no_window_waits_for_the_display_without_need() {
        use vk::PresentModeKHR as Mode;
        let all = [Mode::IMMEDIATE, Mode::MAILBOX, Mode::FIFO];
        assert_eq!(present_mode(&all, true, false), Mode::FIFO);
        assert_eq!(present_mode(&all, false, false), Mode::MAILBOX);
        assert_eq!(present_mode(&[Mode::FIFO, Mode::IMMEDIATE], false, false), Mode::IMMEDIATE);
        assert_eq!(present_mode(&all, true, true), Mode::MAILBOX);
        assert_eq!(present_mode(&[Mode::FIFO], false, true), Mode::FIFO);
    }
}
