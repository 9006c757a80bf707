//! The picture in the window: one sample of it at a time, so that input never waits for more.

use super::Event;
use super::gathering::{Done, Gathering, Origin, Status};
use super::overlay::Change;
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings, Timings};
use crate::gpu::{Device, Image};
use crate::gpu_scene::GpuScene;
use crate::scene::settings::Encoding;
use crate::scene::{Camera, Projection, Scene};
use glam::DVec3;
use indicatif::ProgressBar;
use std::sync::Arc;
use winit::event_loop::EventLoopProxy;

/// A scene on the device, and the picture of it as far as it is refined.
pub(super) struct Picture {
    pub(super) scene: Arc<Scene>,
    pub(super) frame: Frame,
    gathering: Gathering,
    /// Of the last sample, milliseconds.
    direct: f64,
    device: Arc<Device>,
    proxy: EventLoopProxy<Event>,
    /// One sample through the pixels' centres is all that is asked for.
    single: bool,
    /// What the frame's samples show.
    shown: Option<View>,
}

/// What the window asks of pictures.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    /// Pixels across and down.
    pub(super) size: [u32; 2],
    pub(super) encoding: Encoding,
}

/// Whatever begins a new picture when it changes.
#[derive(Clone, PartialEq)]
struct View {
    camera: Camera,
    /// Seconds, where lights move.
    time: f64,
    samples: u32,
    /// Point lights whose light is gathered are seen without shadows.
    preview: bool,
}

/// What a picture is rendered for.
#[derive(Clone, Copy)]
pub(super) struct Occasion {
    /// Seconds since the window opened.
    pub(super) time: f64,
    /// The view moves: a single sample through the pixels' centres is enough.
    pub(super) moves: bool,
    /// Light will be gathered once the picture has its samples.
    pub(super) gathers: bool,
}

impl Picture {
    /// Compiles the passes that an uploaded scene needs.
    pub(super) fn new(
        device: &Arc<Device>,
        gpu: GpuScene,
        scene: Scene,
        camera: &Camera,
        (shape, proxy): (Shape, &EventLoopProxy<Event>),
    ) -> Result<Self> {
        let gpu = Arc::new(gpu);
        let frame = Frame::new(device, &gpu, settings(&scene, camera, shape))?;
        Ok(Self {
            scene: Arc::new(scene),
            frame,
            gathering: Gathering::default(),
            direct: 0.0,
            device: device.clone(),
            proxy: proxy.clone(),
            single: false,
            shown: None,
        })
    }

    /// Makes the frame fit the window, and the kind of camera.
    pub(super) fn fit(&mut self, shape: Shape, camera: &Camera) -> Result<()> {
        let now = self.frame.settings();
        if (now.perspective, now.encoding) != (perspective(camera), shape.encoding) {
            self.frame.retune(settings(&self.scene, camera, shape))?;
            self.shown = None;
        } else if now.size != shape.size {
            self.frame.resize(shape.size)?;
            self.shown = None;
        }
        Ok(())
    }

    /// Renders the next sample, if there is one: a single one through the pixels' centres while the view moves, the scene's
    /// samples, one by one, once it rests.
    pub(super) fn step(&mut self, camera: &Camera, occasion: Occasion) -> Result<Option<Timings>> {
        let Occasion { time, moves, gathers } = occasion;
        self.gathering.pause(moves);
        let time = if self.frame.scene().moves() { time } else { 0.0 };
        let samples = if moves { 1 } else { self.samples() };
        let preview = self.frame.gathers().points && !(gathers && self.gathering.has_lights());
        let view = View { camera: camera.clone(), time, samples, preview };
        let index = if self.shown.as_ref() == Some(&view) { self.frame.samples() } else { 0 };
        if index >= samples {
            return Ok(None);
        }
        self.shown = None;
        if index == 0 {
            self.gathering.restart();
        }
        self.frame.preview(preview);
        let timings = self.frame.refine(&inputs(&self.scene, &view), index)?;
        self.direct = timings.wall_ms;
        self.shown = Some(view);
        Ok(Some(timings))
    }

    /// Goes on with gathered light, where the picture of that camera has its samples: for some milliseconds.
    pub(super) fn gather(&mut self, camera: &Camera) -> Result<Done> {
        let Some(view) = self.shown.as_ref().filter(|view| view.camera == *camera) else {
            return Ok(Done::Nothing);
        };
        if self.single || !self.is_complete() {
            return Ok(Done::Nothing);
        }
        let origin = Origin { device: &self.device, scene: &self.scene, proxy: &self.proxy };
        let inputs = inputs(&self.scene, view);
        self.gathering.step(&mut self.frame, &origin, &inputs, (self.direct, view.preview))
    }

    /// How far gathered light is; `None` where there is none.
    pub(super) fn status(&self) -> Option<Status> {
        self.gathering.status(&self.frame)
    }

    /// Whether the picture still lacks what will be gathered of point lights, which the one before it had.
    pub(super) fn is_dark(&self) -> bool {
        let lacks = |view: &View| !view.preview && !self.single && self.frame.gathered() == 0;
        self.frame.gathers().points && self.shown.as_ref().is_some_and(lacks)
    }

    /// Renders the same view again, from its first sample on.
    pub(super) fn restart(&mut self) {
        self.shown = None;
    }

    /// Makes anew what a change of the scene asks for.
    pub(super) fn change(&mut self, change: Change, camera: &Camera) -> Result<()> {
        if matches!(change, Change::Edit(_) | Change::Scene) || !self.gathering.serves(&self.scene.render) {
            self.gathering.forget();
        }
        let settings = settings(&self.scene, camera, self.shape());
        match change {
            Change::Nothing => return Ok(()),
            Change::Picture => {}
            Change::Edit(edit) => {
                if !self.frame.adopt(&self.scene, edit)? {
                    return self.change(Change::Scene, camera);
                }
            }
            Change::Frame => self.frame.retune(settings)?,
            Change::Scene => {
                let gpu = Arc::new(GpuScene::new(&self.device, &self.scene)?);
                self.frame = Frame::new(&self.device, &gpu, settings)?;
            }
        }
        self.shown = None;
        Ok(())
    }

    /// Compiles every pass anew.
    pub(super) fn remake(&mut self, camera: &Camera) -> Result<()> {
        self.frame.remake(settings(&self.scene, camera, self.shape()))?;
        self.shown = None;
        Ok(())
    }

    fn shape(&self) -> Shape {
        let &FrameSettings { size, encoding, .. } = self.frame.settings();
        Shape { size, encoding }
    }

    /// Asks for a single sample through the pixels' centres, or for the scene's.
    pub(super) fn set_single(&mut self, single: bool) {
        self.single = single;
    }

    /// Of the view at rest.
    pub(super) fn samples(&self) -> u32 {
        if self.single { 1 } else { self.scene.render.samples }
    }

    /// Whether every sample of a view that rests is there.
    pub(super) fn is_complete(&self) -> bool {
        let complete = |view: &View| self.frame.samples() >= view.samples && view.samples == self.samples();
        self.shown.as_ref().is_some_and(complete)
    }

    /// Where the surface is that is seen at a pixel.
    pub(super) fn pick(&self, pixel: [u32; 2]) -> Result<Option<DVec3>> {
        self.frame.position_at(pixel)
    }

    /// On the device, display-referred.
    pub(super) fn image(&self) -> &Arc<Image> {
        self.frame.picture()
    }

    /// From corner to corner of the scene's surfaces, metres; `None` without any.
    pub(super) fn diagonal(&self) -> Option<f64> {
        self.frame.scene().bounds.map(|[lower, upper]| lower.distance(upper))
    }
}

fn perspective(camera: &Camera) -> bool {
    matches!(camera.projection, Projection::Perspective { .. })
}

fn settings(scene: &Scene, camera: &Camera, Shape { size, encoding }: Shape) -> FrameSettings {
    FrameSettings { size, encoding, preview: true, ..FrameSettings::new(&scene.render, camera) }
}

fn inputs<'a>(scene: &Scene, view: &'a View) -> FrameInputs<'a> {
    FrameInputs {
        camera: &view.camera,
        time: view.time,
        samples: view.samples,
        exposure: scene.render.exposure,
        split: false,
        progress: ProgressBar::hidden(),
    }
}
