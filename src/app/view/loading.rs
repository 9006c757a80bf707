//! Loading beside the window's thread: first the files, then the device.

use super::Event;
use super::picture::{Picture, Shape};
use crate::app::args::SceneOptions;
use crate::app::{camera_index, in_scene, load_watched, warn_of_missing_shadows};
use crate::error::{Error, Result};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::scene::{Camera, Scene};
use indicatif::{ProgressBar, ProgressDrawTarget};
use std::sync::Arc;
use std::thread::JoinHandle;
use winit::event_loop::EventLoopProxy;

/// Steps on the device, besides those of the files.
const DEVICE_STEPS: u64 = 2;

/// What is being loaded.
pub(super) struct Loading {
    pub(super) options: SceneOptions,
    /// Camera to start from, by name.
    camera: Option<String>,
    progress: ProgressBar,
    /// Tells this job's events from those of jobs that were cancelled.
    ticket: u64,
    /// Uses the device, and so must end before the program does.
    upload: Option<JoinHandle<()>>,
    proxy: EventLoopProxy<Event>,
}

/// What a job has come to.
pub(super) enum Progress {
    /// The files are read.
    Read(Result<Scene>),
    /// The scene is on the device.
    Ready(Result<Box<Picture>>),
}

impl Loading {
    /// Begins to read the files.
    pub(super) fn start(
        options: SceneOptions,
        camera: Option<String>,
        ticket: u64,
        proxy: &EventLoopProxy<Event>,
    ) -> Self {
        let progress = ProgressBar::with_draw_target(Some(DEVICE_STEPS), ProgressDrawTarget::hidden());
        let job = Self { options, camera, progress, ticket, upload: None, proxy: proxy.clone() };
        let (options, progress, proxy) = (job.options.clone(), job.progress.clone(), job.proxy.clone());
        // Not waited for where it is cancelled: it touches no device, and its result is dropped.
        std::thread::spawn(move || {
            let scene = load_watched(&options, &progress);
            // Without an event loop nobody waits for it.
            let _ = proxy.send_event(Event::Loaded(ticket, Progress::Read(scene)));
        });
        job
    }

    /// Whether an event is of this job.
    pub(super) fn is(&self, ticket: u64) -> bool {
        self.ticket == ticket
    }

    /// From 0 to 1.
    pub(super) fn fraction(&self) -> f64 {
        let length = self.progress.length().unwrap_or(DEVICE_STEPS).max(1);
        self.progress.position() as f64 / length as f64
    }

    /// The camera to start from, of a scene that was read.
    pub(super) fn camera(&self, scene: &Scene) -> Result<usize> {
        in_scene(&self.options, camera_index(scene, self.camera.as_deref()))
    }

    /// Goes on to the device, for a picture of that shape.
    pub(super) fn upload(&mut self, device: &Arc<Device>, scene: Scene, camera: &Camera, shape: Shape) {
        let (device, camera, ticket) = (device.clone(), camera.clone(), self.ticket);
        let (options, progress, proxy) = (self.options.clone(), self.progress.clone(), self.proxy.clone());
        self.upload = Some(std::thread::spawn(move || {
            let picture = build(&device, scene, &camera, shape, &progress);
            let picture = in_scene(&options, picture).map(Box::new);
            let _ = proxy.send_event(Event::Loaded(ticket, Progress::Ready(picture)));
        }));
    }
}

/// Cancelled, or done.
impl Drop for Loading {
    fn drop(&mut self) {
        self.progress.abandon();
        if let Some(upload) = self.upload.take() {
            // A panic was reported on its thread.
            let _ = upload.join();
        }
    }
}

fn build(
    device: &Arc<Device>,
    scene: Scene,
    camera: &Camera,
    shape: Shape,
    progress: &ProgressBar,
) -> Result<Picture> {
    let going_on = || match progress.is_finished() {
        true => Err(Error::usage("loading was cancelled", "load the scene again")),
        false => Ok(progress.inc(1)),
    };
    warn_of_missing_shadows(&scene);
    let gpu = GpuScene::new(device, &scene)?;
    going_on()?;
    let picture = Picture::new(device, gpu, scene, camera, shape)?;
    going_on()?;
    Ok(picture)
}
