//! Loading beside the window's thread: first the files, then the device.

use super::Event;
use super::picture::{Picture, Shape};
use super::worker::Worker;
use crate::app::args::SceneOptions;
use crate::app::{camera_index, in_scene, load_watched};
use crate::error::{Error, Result};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::scene::{Camera, Scene};
use indicatif::{ProgressBar, ProgressDrawTarget};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::SystemTime;
use winit::event_loop::EventLoopProxy;

/// Steps on the device, besides those of the files.
const DEVICE_STEPS: u64 = 2;

/// What is being loaded.
pub(super) struct Loading {
    pub(super) options: SceneOptions,
    pub(super) aim: Aim,
    /// When reading began.
    pub(super) since: SystemTime,
    progress: ProgressBar,
    /// Tells this job's events from those of jobs that were cancelled.
    pub(super) ticket: u64,
    /// Whether the device is in use for it.
    uploads: bool,
    worker: Worker,
    proxy: EventLoopProxy<Event>,
}

/// What a scene is loaded for.
#[derive(Clone, PartialEq)]
pub(super) enum Aim {
    /// To be the first in the window, seen from the camera of that name.
    First(Option<String>),
    /// To take the place of the one that is there.
    Other,
    /// The one that is there, once more: the camera stays.
    Again,
}

/// What a job has come to.
pub(super) enum Progress {
    /// The files are read.
    Read(Result<Box<Scene>>),
    /// The scene is on the device.
    Ready(Result<Box<Picture>>),
}

impl Loading {
    /// Begins to read the files.
    pub(super) fn start(
        options: SceneOptions,
        aim: Aim,
        ticket: u64,
        proxy: &EventLoopProxy<Event>,
        worker: Worker,
    ) -> Self {
        let progress = ProgressBar::with_draw_target(Some(DEVICE_STEPS), ProgressDrawTarget::hidden());
        let job = Self {
            options,
            aim,
            since: SystemTime::now(),
            progress,
            ticket,
            uploads: false,
            worker,
            proxy: proxy.clone(),
        };
        let (options, progress, proxy) = (job.options.clone(), job.progress.clone(), job.proxy.clone());
        job.worker.run(move || {
            let scene = load_watched(&options, &progress).map(Box::new);
            // Without an event loop nobody waits for it.
            let _ = proxy.send_event(Event::Loaded(ticket, Progress::Read(scene)));
        });
        job
    }

    /// Has it end where it is. A thread that uses the device must be waited for before the device is gone; one that reads files
    /// ends with the program, if not before, and what it reads is dropped.
    #[must_use]
    pub(super) fn cancel(self) -> Option<JoinHandle<()>> {
        self.progress.abandon();
        let thread = self.worker.retire();
        self.uploads.then_some(thread)
    }

    /// It has come to its end; the worker is free.
    pub(super) fn end(self) -> Worker {
        self.worker
    }

    /// From 0 to 1: reading is one half, the device the other, which takes longest where no pipeline is in the driver's cache.
    pub(super) fn fraction(&self) -> f64 {
        let files = self.progress.length().unwrap_or(DEVICE_STEPS).saturating_sub(DEVICE_STEPS);
        share(self.progress.position(), files)
    }

    /// The camera to start from, of a scene that was read.
    pub(super) fn camera(&self, scene: &Scene) -> Result<usize> {
        let name = match &self.aim {
            Aim::First(name) => name.as_deref(),
            Aim::Other | Aim::Again => None,
        };
        in_scene(&self.options, camera_index(scene, name))
    }

    /// Goes on to the device, for a picture of that shape.
    pub(super) fn upload(&mut self, device: &Arc<Device>, scene: Scene, camera: &Camera, shape: Shape) {
        let (device, camera, ticket) = (device.clone(), camera.clone(), self.ticket);
        let (options, progress, proxy) = (self.options.clone(), self.progress.clone(), self.proxy.clone());
        self.uploads = true;
        self.worker.run(move || {
            let picture = build(&device, scene, &camera, (shape, &proxy), &progress);
            let picture = in_scene(&options, picture).map(Box::new);
            // Not later than the window's thread, which is told below.
            drop(device);
            let _ = proxy.send_event(Event::Loaded(ticket, Progress::Ready(picture)));
        });
    }
}

/// How far `done` steps are, of which the first are `files`.
fn share(done: u64, files: u64) -> f64 {
    let read = if files > 0 { done.min(files) as f64 / files as f64 } else { 0.0 };
    let device = done.saturating_sub(files) as f64 / DEVICE_STEPS as f64;
    0.5 * (read + device.min(1.0))
}

fn build(
    device: &Arc<Device>,
    scene: Scene,
    camera: &Camera,
    window: (Shape, &EventLoopProxy<Event>),
    progress: &ProgressBar,
) -> Result<Picture> {
    let going_on = || {
        progress.inc(1);
        match progress.is_finished() {
            true => Err(Error::usage("loading was cancelled", "load the scene again")),
            false => Ok(()),
        }
    };
    let gpu = GpuScene::new(device, &scene)?;
    going_on()?;
    let picture = Picture::new(device, gpu, scene, camera, window)?;
    device.keep_pipelines();
    going_on()?;
    Ok(picture)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reading_is_half_of_loading() {
        assert_eq!(share(0, 0), 0.0);
        assert_eq!([0, 2, 4, 5, 6].map(|done| share(done, 4)), [0.0, 0.25, 0.5, 0.75, 1.0]);
    }
}
