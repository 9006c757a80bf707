//! Gathered light, round by round.

use super::figures::{Family, Sample};
use super::truth::{Truth, mean};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings, Timings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::refine::Rounds;
use crate::scene::Scene;
use crate::shared::GATHER_FRAMES;
use glam::Vec3;
use indicatif::ProgressBar;
use std::sync::Arc;

/// Rounds that repetitions are apart: their virtual lights are others.
const APART: u32 = 1 << 16;

/// A frame that is refined again and again.
pub(super) struct Gatherer<'a> {
    device: &'a Arc<Device>,
    scene: &'a Scene,
    gpu_scene: Arc<GpuScene>,
    frame: Frame,
}

impl<'a> Gatherer<'a> {
    /// Direct light is there, and the pipelines are compiled: lavapipe does so again, for 1.5 CPU s, where a texture's height
    /// is a power of two and was none before, so that each number of virtual lights has a round beforehand.
    pub(super) fn new(device: &'a Arc<Device>, scene: &'a Scene, vpls: &[u32]) -> Result<Self> {
        let gpu_scene = Arc::new(GpuScene::new(device, scene)?);
        let settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
        let mut frame = Frame::new(device, &gpu_scene, settings)?;
        frame.render(&inputs(scene))?;
        let mut gatherer = Self { device, scene, gpu_scene, frame };
        vpls.iter().try_for_each(|&vpls| gatherer.rounds(vpls, 0, 1, |_, _| Ok(())))?;
        Ok(gatherer)
    }

    /// What lights' places are relative to.
    pub(super) fn origin(&self) -> Vec3 {
        self.gpu_scene.origin
    }

    /// Mean of all values of direct light.
    pub(super) fn direct_mean(&mut self) -> Result<f64> {
        self.frame.render(&inputs(self.scene))?;
        Ok(mean(&self.frame.hdr()?, |value, _| value))
    }

    /// Pictures after 1, 2, 4 … rounds of so many virtual lights.
    pub(super) fn refine(
        &mut self,
        truth: &Truth,
        count: u32,
        repetition: u32,
        most: u32,
    ) -> Result<Vec<Sample>> {
        let mut samples = Vec::new();
        self.rounds(count, repetition * APART, most, |frame, taken| {
            let rounds = frame.gathered() / GATHER_FRAMES;
            if !rounds.is_power_of_two() {
                return Ok(());
            }
            let Some([indirect, points]) = frame.gathered_light()? else { return Ok(()) };
            let [square, bias] = truth.judge(&indirect.plus(&points));
            let (cpu_s, wall_s) = (1e-3 * taken.cpu_ms, 1e-3 * taken.wall_ms);
            let estimate = frame.gathered_error()?;
            let family = Family::Gathered;
            samples.push(Sample { family, count, rounds, cpu_s, wall_s, square, bias, estimate });
            Ok(())
        })?;
        Ok(samples)
    }

    /// Gathers so many rounds anew, and shows what each leaves and all have taken, the tracer's setting up included.
    fn rounds(
        &mut self,
        vpls: u32,
        first: u32,
        most: u32,
        mut look: impl FnMut(&Frame, &Timings) -> Result<()>,
    ) -> Result<()> {
        let Self { device, scene, gpu_scene, frame } = self;
        let mut scene = scene.clone();
        scene.render.vpls = vpls;
        let inputs = inputs(&scene);
        // Forgets what was gathered.
        frame.render(&inputs)?;
        let mut rounds = None;
        let mut taken = Timings::of("trace", || {
            rounds = Some(Rounds::new(&scene, gpu_scene.origin, frame.gathers(), 0.0));
            Ok(())
        })?;
        for number in first..first + most {
            taken.add(&Timings::of("trace", || {
                rounds.as_ref().map_or(Ok(()), |rounds| rounds.light(frame, device, number))
            })?);
            for _ in 0..GATHER_FRAMES {
                taken.add(&frame.gather(&inputs)?);
            }
            look(frame, &taken)?;
        }
        Ok(())
    }
}

fn inputs(scene: &Scene) -> FrameInputs<'_> {
    FrameInputs {
        camera: &scene.cameras[0],
        time: 0.0,
        samples: 1,
        exposure: 0.0,
        split: false,
        progress: ProgressBar::hidden(),
    }
}
