//! The open window and its device: where pictures go.

use super::folders;
use crate::app::args::ViewOptions;
use crate::app::terminal::complain;
use crate::error::{Error, Result};
use crate::gpu::{Device, Image, Shown, Swapchain, WindowOptions};
use crate::scene::settings::Encoding;
use std::sync::Arc;
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// Everything that lives as long as the window.
pub(super) struct Stage {
    swapchain: Swapchain,
    pub(super) device: Arc<Device>,
    pub(super) window: Arc<Window>,
    /// Of the window, pixels, as its events say: asked about a window that is gone, winit panics on X11.
    size: [u32; 2],
    /// Whether the images fit the window.
    fits: bool,
    vsync: bool,
    title: String,
}

/// Opens the window.
pub(super) fn window(event_loop: &ActiveEventLoop, [width, height]: [u32; 2]) -> Result<Arc<Window>> {
    let attributes =
        Window::default_attributes().with_title("amas").with_inner_size(PhysicalSize::new(width, height));
    let window = event_loop.create_window(attributes).map_err(|error| Error::NoDisplay {
        cause: format!("the window cannot be opened ({error})"),
        remedy: "check the display".into(),
    })?;
    Ok(Arc::new(window))
}

impl Stage {
    /// Opens the device that presents to a window just opened.
    pub(super) fn open(
        event_loop: &ActiveEventLoop,
        options: &ViewOptions,
        window: Arc<Window>,
    ) -> Result<Self> {
        let size = window.inner_size().into();
        let wanted = WindowOptions { high: options.hdr, cache: folders::cache() };
        let asked = options.device.asked();
        let (device, mut swapchain) =
            Device::open_for_window(&asked, &window, event_loop.owned_display_handle(), &wanted)?;
        if options.hdr && swapchain.encoding() == Encoding::Srgb {
            complain("warning: the display offers no high dynamic range; the window shows sRGB");
        }
        swapchain.set_vsync(!options.no_vsync);
        Ok(Self {
            swapchain,
            device,
            size,
            window,
            fits: false,
            vsync: !options.no_vsync,
            title: String::new(),
        })
    }

    /// The window has that size now: its images are made anew before the next picture.
    pub(super) fn resized(&mut self, size: PhysicalSize<u32>) {
        self.size = size.into();
        self.fits = false;
    }

    /// Of the window, pixels; 0 where it has no area.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Lets the window's images go until it is resumed.
    pub(super) fn suspend(&mut self) {
        self.swapchain.suspend();
        self.fits = false;
    }

    /// Turns waiting for the display's refresh on or off; whether it is on now.
    pub(super) fn toggle_vsync(&mut self) -> bool {
        self.vsync = !self.vsync;
        self.swapchain.set_vsync(self.vsync);
        self.fits = false;
        self.vsync
    }

    /// How pictures for the window are to be encoded.
    pub(super) fn encoding(&self) -> Encoding {
        self.swapchain.encoding()
    }

    /// Makes the images fit the window, and says how large they are; `None` where it has no area.
    pub(super) fn fit(&mut self) -> Result<Option<[u32; 2]>> {
        if !self.fits {
            self.fits = self.swapchain.resize(self.size)?;
        }
        Ok(self.fits.then(|| self.swapchain.size()))
    }

    /// Sends a picture to the window; whether it is on its way to the screen.
    pub(super) fn show(&mut self, picture: &Arc<Image>) -> Result<bool> {
        // Wayland says when it wants the next one; asked for it without a picture, it would never answer.
        let (window, vsync) = (&self.window, self.vsync);
        let shown = self.swapchain.show(picture, || {
            if vsync {
                window.pre_present_notify();
            }
        })?;
        if matches!(shown, Shown::Misfit | Shown::OutOfDate) {
            self.fits = false;
        }
        Ok(matches!(shown, Shown::Yes | Shown::Misfit))
    }

    /// Sets the title, if it is another.
    pub(super) fn entitle(&mut self, title: String) {
        if self.title != title {
            self.window.set_title(&title);
            self.title = title;
        }
    }

    /// Asks for a window of that size; what comes of it is up to the display.
    pub(super) fn ask_size(&mut self, [width, height]: [u32; 2]) {
        if let Some(size) = self.window.request_inner_size(PhysicalSize::new(width, height)) {
            // Granted at once, and so without an event: on Wayland a window has the size that it gives itself.
            self.resized(size);
            self.window.request_redraw();
        }
    }

    /// Pixels of the window's height, at least 1: what drags are measured by.
    pub(super) fn height(&self) -> f64 {
        f64::from(self.size[1].max(1))
    }
}
