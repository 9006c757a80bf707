//! A frame that is rendered again and again.

use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings, Timings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::scene::Scene;
use indicatif::ProgressBar;
use std::sync::Arc;

/// Frames before any is measured.
const WARMUP: usize = 3;

pub(super) struct Subject {
    pub(super) scene: Scene,
    pub(super) frame: Frame,
    /// Of every frame that was measured.
    pub(super) timings: Vec<Timings>,
}

impl Subject {
    /// Its first camera's frame with the samples that it asks for, warmed up.
    pub(super) fn new(device: &Arc<Device>, scene: Scene) -> Result<Self> {
        let gpu_scene = Arc::new(GpuScene::new(device, &scene)?);
        let settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
        let frame = Frame::new(device, &gpu_scene, settings)?;
        let mut subject = Self { scene, frame, timings: Vec::new() };
        for _ in 0..WARMUP {
            subject.render()?;
        }
        Ok(subject)
    }

    pub(super) fn measure(&mut self) -> Result<()> {
        let taken = self.render()?;
        self.timings.push(taken);
        Ok(())
    }

    fn render(&mut self) -> Result<Timings> {
        self.frame.render(&FrameInputs {
            camera: &self.scene.cameras[0],
            time: 0.0,
            samples: self.scene.render.samples,
            exposure: 0.0,
            split: false,
            progress: ProgressBar::hidden(),
        })
    }

    /// Milliseconds of each frame: CPU time on a CPU device, device time on others that tell it.
    pub(super) fn times(&self, device: &Device) -> Vec<f64> {
        self.timings.iter().map(|taken| frame_ms(device, taken)).collect()
    }
}

/// Milliseconds of a frame, as [`Subject::times`] has them.
fn frame_ms(device: &Device, taken: &Timings) -> f64 {
    device_ms(taken).filter(|_| !device.is_cpu()).unwrap_or(taken.cpu_ms)
}

/// Device time of all passes; `None` where the device does not tell.
pub(super) fn device_ms(taken: &Timings) -> Option<f64> {
    taken.passes.iter().map(|pass| pass.gpu_ms).sum()
}
