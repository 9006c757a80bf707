//! Gathered light, frame by frame: indirect light, and point lights with shadows.

use crate::error::Result;
use crate::frame::{Frame, FrameInputs, Timings};
use crate::gpu::Device;
use crate::passes::gather::{Gathered, GatheredLights};
use crate::scene::Scene;
use crate::shared::GATHER_FRAMES;
use crate::virtual_lights::{Proceed, Tracer, VirtualTree};
use glam::Vec3;
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

/// The lights of a round, and the trees over them.
pub(super) struct Round<'a> {
    points: &'a VirtualTree,
    emitters: VirtualTree,
    virtuals: VirtualTree,
    spacing: f32,
}

impl<'a> Rounds<'a> {
    /// Of a scene at a time in seconds, for what a frame gathers; lights will be relative to `origin`.
    pub(super) fn new(scene: &'a Scene, origin: Vec3, wanted: Gathered, time: f64) -> Self {
        let lights = if wanted.anything() { scene.point_lights_at(time) } else { Vec::new() };
        Self {
            scene,
            tracer: wanted.indirect.then(|| Tracer::at(scene, origin, time)),
            points: VirtualTree::of_points(&lights, origin),
        }
    }

    /// Whether each round has lights of its own.
    pub(super) fn differ(&self) -> bool {
        self.tracer.is_some()
    }

    /// A round; `None` where `proceed` says so.
    pub(super) fn round(&self, number: u32, proceed: Proceed<'_>) -> Option<Round<'_>> {
        let points = &self.points;
        let Some(tracer) = &self.tracer else {
            return Some(Round {
                points,
                emitters: VirtualTree::default(),
                virtuals: VirtualTree::default(),
                spacing: 1.0,
            });
        };
        let set = tracer.trace_while(self.scene.render.vpls as usize, u64::from(number), proceed)?;
        let emitters = VirtualTree::new(&set.emitters);
        let virtuals = VirtualTree::new_while(&set.bounced, proceed)?;
        Some(Round { points, emitters, virtuals, spacing: set.spacing })
    }
}

impl Round<'_> {
    /// Lights that stand for reflected light.
    #[cfg(feature = "viewer")]
    pub(super) fn virtual_lights(&self) -> usize {
        self.virtuals.lights.len()
    }

    /// On the device.
    pub(super) fn upload(&self, device: &Arc<Device>) -> Result<GatheredLights> {
        GatheredLights::new(device, [self.points, &self.emitters, &self.virtuals], self.spacing)
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
        let number = frame.gathered() / GATHER_FRAMES;
        if number == 0 || rounds.differ() {
            timings.add(&Timings::of("trace", || {
                rounds.round(number, &|| true).map_or(Ok(()), |round| {
                    frame.set_gathered_lights(round.upload(device)?);
                    Ok(())
                })
            })?);
        }
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
