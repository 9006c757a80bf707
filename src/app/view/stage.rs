//! The open window: device, scene and frame, and the picture's way into the window.

use super::overlay::{Change, Content, Figures, Gui, History};
use crate::app::args::ViewOptions;
use crate::app::{in_scene, report, warn_of_missing_shadows};
use crate::error::{Error, Result};
use crate::frame::{Frame, FrameInputs, FrameSettings};
use crate::gpu::{Device, Options, Shown, Swapchain};
use crate::gpu_scene::GpuScene;
use crate::passes::overlay::Ground;
use crate::scene::{Camera, Scene};
use std::sync::Arc;
use std::time::Instant;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::ActiveEventLoop;
use winit::keyboard::KeyCode;
use winit::window::Window;

/// Everything that lives as long as the window.
pub(super) struct Stage {
    /// `None` before the first picture, and after the window has changed its size.
    frame: Option<Frame>,
    swapchain: Swapchain,
    scene: Arc<GpuScene>,
    pub(super) device: Arc<Device>,
    pub(super) window: Arc<Window>,
    gui: Gui,
    figures: Figures,
    history: History,
    warned: bool,
}

/// What a picture is of.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) camera: &'a Camera,
    /// Seconds.
    pub(super) time: f64,
    pub(super) samples: u32,
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
        Ok(Self {
            frame: None,
            swapchain,
            scene: gpu_scene,
            device,
            window,
            gui: Gui::default(),
            figures: Figures::default(),
            history: History::default(),
            warned: false,
        })
    }

    /// Has the targets made anew before the next picture.
    pub(super) fn outdate(&mut self) {
        self.frame = None;
    }

    /// Whether there is a picture to show.
    pub(super) fn has_picture(&self) -> bool {
        self.frame.is_some()
    }

    /// Renders a picture; `false` where the window has no area.
    pub(super) fn render(&mut self, scene: &Scene, view: View<'_>) -> Result<bool> {
        if self.frame.is_none() {
            self.frame = self.make_frame(scene, view.camera)?;
        }
        let Some(frame) = &mut self.frame else {
            return Ok(false);
        };
        let timings = frame.render(&FrameInputs {
            camera: view.camera,
            time: view.time,
            samples: view.samples,
            exposure: scene.render.exposure,
            split: false,
            progress: indicatif::ProgressBar::hidden(),
        })?;
        self.history.add(&timings, view.samples);
        if self.gui.panels {
            let samples = [view.samples, scene.render.samples];
            self.figures = Figures::new((&self.device, &self.scene, frame), samples)?;
        }
        if !self.warned && frame.counters().overflowed > 0 {
            report::warn_of_overflow(&frame.counters(), scene.render.max_lights_per_cluster);
            self.warned = true;
        }
        Ok(true)
    }

    /// Shows the picture, with the overlay over it, and says what the user changed there.
    pub(super) fn show(&mut self, scene: &mut Scene) -> Result<(Shown, Change)> {
        let Some(frame) = &self.frame else {
            return Ok((Shown::OutOfDate, Change::Nothing));
        };
        let (mut picture, mut change) = (frame.picture(), Change::Nothing);
        if self.gui.is_shown() {
            let ground = Ground { picture, beside: None };
            let mut content =
                Content { figures: &self.figures, history: &self.history, render: &mut scene.render };
            (picture, change) = self.gui.draw((&self.device, &self.window), &ground, &mut content)?;
        }
        self.window.pre_present_notify();
        let shown = self.swapchain.show(picture)?;
        if matches!(shown, Shown::Misfit | Shown::OutOfDate) {
            self.outdate();
        }
        Ok((shown, change))
    }

    /// Makes anew what a change asks for.
    pub(super) fn change(
        &mut self,
        options: &ViewOptions,
        scene: &Scene,
        camera: &Camera,
        change: Change,
    ) -> Result<()> {
        if change == Change::Scene {
            self.scene = Arc::new(in_scene(&options.scene, GpuScene::new(&self.device, scene))?);
            self.frame = None;
        }
        let settings = self.settings(scene, camera);
        match &mut self.frame {
            Some(frame) if change == Change::Frame => frame.retune(settings),
            _ => Ok(()),
        }
    }

    fn settings(&self, scene: &Scene, camera: &Camera) -> FrameSettings {
        FrameSettings { size: self.swapchain.size(), ..FrameSettings::new(&scene.render, camera) }
    }

    /// Whether the key is the overlay's.
    pub(super) fn key(&mut self, code: KeyCode) -> bool {
        let shown = match code {
            KeyCode::KeyO => &mut self.gui.panels,
            KeyCode::Slash | KeyCode::F1 => &mut self.gui.keys,
            _ => return false,
        };
        *shown = !*shown;
        self.window.request_redraw();
        true
    }

    /// Whether an event is the overlay's alone.
    pub(super) fn overlay_takes(&mut self, event: &WindowEvent) -> bool {
        let taken = self.gui.event(&self.window, event);
        if taken.redraw {
            self.window.request_redraw();
        }
        taken.whole
    }

    /// When the overlay wants to be drawn again of itself.
    pub(super) fn due(&self) -> Option<Instant> {
        self.gui.due()
    }

    fn make_frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Option<Frame>> {
        if !self.swapchain.resize(self.window.inner_size().into())? {
            return Ok(None);
        }
        Frame::new(&self.device, &self.scene, self.settings(scene, camera)).map(Some)
    }
}
