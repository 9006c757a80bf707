//! Gathered light, frame by frame: indirect light, and point lights with shadows.

use crate::error::Result;
use crate::frame::{Frame, FrameInputs, Timings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::passes::gather::GatheredLights;
use crate::scene::Scene;
use crate::shared::GATHER_FRAMES;
use crate::virtual_lights::{Tracer, VirtualTree};
use std::sync::Arc;
use std::time::Instant;

/// When a picture is good enough.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    /// Estimated relative error.
    pub(super) error: f64,
    /// Seconds.
    pub(super) time_limit: Option<f64>,
}

/// Where the lights of each round come from.
pub(super) struct Rounds<'a> {
    scene: &'a Scene,
    tracer: Option<Tracer<'a>>,
    points: VirtualTree,
}

impl<'a> Rounds<'a> {
    /// Of a scene at a time in seconds, for what a frame gathers.
    pub(super) fn new(scene: &'a Scene, gpu_scene: &GpuScene, frame: &Frame, time: f64) -> Self {
        let wanted = frame.gathers();
        let lights = if wanted.anything() { scene.point_lights_at(time) } else { Vec::new() };
        Self {
            scene,
            tracer: wanted.indirect.then(|| Tracer::new(scene, gpu_scene.origin)),
            points: VirtualTree::of_points(&lights, gpu_scene.origin),
        }
    }

    /// The lights of a round.
    pub(super) fn lights(&self, device: &Arc<Device>, round: u32) -> Result<GatheredLights> {
        let none = VirtualTree::default();
        let Some(tracer) = &self.tracer else {
            return GatheredLights::new(device, [&self.points, &none, &none], 1.0);
        };
        let set = tracer.trace(self.scene.render.vpls as usize, u64::from(round));
        let [emitters, virtuals] = [VirtualTree::new(&set.emitters), VirtualTree::new(&set.bounced)];
        GatheredLights::new(device, [&self.points, &emitters, &virtuals], set.spacing)
    }
}

/// Refines the picture last rendered until it is good enough; what that took, and the error that is left, if it is known.
pub(super) fn refine(
    frame: &mut Frame,
    rounds: &Rounds<'_>,
    device: &Arc<Device>,
    inputs: &FrameInputs<'_>,
    goal: Goal,
) -> Result<(Timings, Option<f64>)> {
    let start = Instant::now();
    let mut timings = Timings::default();
    loop {
        timings.add(&Timings::of("trace", || {
            let lights = rounds.lights(device, frame.gathered() / GATHER_FRAMES)?;
            frame.set_gathered_lights(lights);
            Ok(())
        })?);
        for _ in 0..GATHER_FRAMES {
            timings.add(&frame.gather(inputs)?);
            if goal.time_limit.is_some_and(|limit| start.elapsed().as_secs_f64() >= limit) {
                return Ok((timings, frame.gathered_error()?));
            }
        }
        let error = frame.gathered_error()?;
        if error.is_some_and(|error| error <= goal.error) {
            return Ok((timings, error));
        }
    }
}
