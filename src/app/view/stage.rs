//! The open window: device, scene and frame, and the picture's way into the window.

use crate::app::args::ViewOptions;
use crate::app::{in_scene, report, warn_of_missing_shadows};
use crate::error::{Error, Result};
use crate::frame::{Frame, FrameInputs, FrameSettings};
use crate::gpu::{Device, Options, Shown, Swapchain};
use crate::gpu_scene::GpuScene;
use crate::scene::{Camera, Scene};
use std::sync::Arc;
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// Everything that lives as long as the window.
pub(super) struct Stage {
    /// `None` before the first picture, and after the window has changed its size.
    frame: Option<Frame>,
    swapchain: Swapchain,
    scene: Arc<GpuScene>,
    pub(super) device: Arc<Device>,
    pub(super) window: Arc<Window>,
    warned: bool,
}

impl Stage {
    /// Opens the window and the device, and uploads the scene.
    pub(super) fn open(event_loop: &ActiveEventLoop, options: &ViewOptions, scene: &Scene) -> Result<Self> {
        let title = match &options.scene.scene {
            Some(path) => format!("amas: {}", path.display()),
            None => "amas".into(),
        };
        let [width, height] = scene.render.size;
        let attributes =
            Window::default_attributes().with_title(title).with_inner_size(PhysicalSize::new(width, height));
        let window = event_loop.create_window(attributes).map_err(|error| Error::NoDevice {
            cause: format!("the window cannot be opened ({error})"),
            remedy: "check the display".into(),
        })?;
        let window = Arc::new(window);
        let asked = Options { device: options.device.device.clone(), validate: options.device.validate };
        let (device, swapchain) =
            Device::open_for_window(&asked, &window, event_loop.owned_display_handle())?;
        let gpu_scene = Arc::new(in_scene(&options.scene, GpuScene::new(&device, scene))?);
        warn_of_missing_shadows(scene);
        Ok(Self { frame: None, swapchain, scene: gpu_scene, device, window, warned: false })
    }

    /// Has the targets made anew before the next picture.
    pub(super) fn outdate(&mut self) {
        self.frame = None;
    }

    /// Renders a picture and shows it; `None` where the window has no area.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        time: f64,
        samples: u32,
    ) -> Result<Option<Shown>> {
        if self.frame.is_none() {
            self.frame = self.make_frame(scene, camera)?;
        }
        let Some(frame) = &mut self.frame else {
            return Ok(None);
        };
        frame.render(&FrameInputs {
            camera,
            time,
            samples,
            exposure: scene.render.exposure,
            split: false,
            progress: indicatif::ProgressBar::hidden(),
        })?;
        if !self.warned && frame.counters().overflowed > 0 {
            report::warn_of_overflow(&frame.counters(), scene.render.max_lights_per_cluster);
            self.warned = true;
        }
        self.window.pre_present_notify();
        let shown = self.swapchain.show(frame.picture())?;
        if matches!(shown, Shown::Misfit | Shown::OutOfDate) {
            self.outdate();
        }
        Ok(Some(shown))
    }

    fn make_frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Option<Frame>> {
        if !self.swapchain.resize(self.window.inner_size().into())? {
            return Ok(None);
        }
        let settings =
            FrameSettings { size: self.swapchain.size(), ..FrameSettings::new(&scene.render, camera) };
        Frame::new(&self.device, &self.scene, settings).map(Some)
    }
}
