//! The picture in the window: one sample of it at a time, so that input never waits for more.

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

/// A scene on the device, and the picture of it as far as it is refined.
pub(super) struct Picture {
    pub(super) scene: Scene,
    pub(super) frame: Frame,
    device: Arc<Device>,
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
}

impl Picture {
    /// Compiles the passes that an uploaded scene needs.
    pub(super) fn new(
        device: &Arc<Device>,
        gpu: GpuScene,
        scene: Scene,
        camera: &Camera,
        shape: Shape,
    ) -> Result<Self> {
        let gpu = Arc::new(gpu);
        let frame = Frame::new(device, &gpu, settings(&scene, camera, shape))?;
        Ok(Self { scene, frame, device: device.clone(), single: false, shown: None })
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

    /// Renders the next sample, if there is one: a single one through the pixels' centres while the view `moves`, the scene's
    /// samples, one by one, once it rests.
    pub(super) fn step(&mut self, camera: &Camera, time: f64, moves: bool) -> Result<Option<Timings>> {
        let time = if self.frame.scene().moves() { time } else { 0.0 };
        let samples = if moves { 1 } else { self.samples() };
        let view = View { camera: camera.clone(), time, samples };
        let index = if self.shown.as_ref() == Some(&view) { self.frame.samples() } else { 0 };
        if index >= samples {
            return Ok(None);
        }
        self.shown = None;
        let timings = self.frame.refine(
            &FrameInputs {
                camera,
                time,
                samples,
                exposure: self.scene.render.exposure,
                split: false,
                progress: ProgressBar::hidden(),
            },
            index,
        )?;
        self.shown = Some(view);
        Ok(Some(timings))
    }

    /// Renders the same view again, from its first sample on.
    pub(super) fn restart(&mut self) {
        self.shown = None;
    }

    /// Makes anew what a change of the scene asks for.
    pub(super) fn change(&mut self, change: Change, camera: &Camera) -> Result<()> {
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
    FrameSettings { size, encoding, ..FrameSettings::new(&scene.render, camera) }
}
