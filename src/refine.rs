//! Rounds of gathered light: lights anew for each, and a frame for each of its strata.

use crate::error::Result;
use crate::frame::{Frame, FrameInputs, Timings};
use crate::gpu::Device;
use crate::passes::gather::{Gathered, GatheredLights};
use crate::scene::Scene;
use crate::shared::GATHER_FRAMES;
use crate::virtual_lights::{Proceed, Tracer, VirtualTree};
use glam::Vec3;
use std::sync::Arc;

/// Where the lights of each round come from.
pub struct Rounds<'a> {
    scene: &'a Scene,
    tracer: Option<Tracer<'a>>,
    points: VirtualTree,
}

/// The lights of a round, and the trees over them.
pub struct Round<'a> {
    points: &'a VirtualTree,
    emitters: VirtualTree,
    virtuals: VirtualTree,
    spacing: f32,
}

impl<'a> Rounds<'a> {
    /// Of a scene at a time in seconds, for what a frame gathers; lights will be relative to `origin`.
    #[must_use]
    pub fn new(scene: &'a Scene, origin: Vec3, wanted: Gathered, time: f64) -> Self {
        let lights = if wanted.anything() { scene.point_lights_at(time) } else { Vec::new() };
        Self {
            scene,
            tracer: wanted.indirect.then(|| Tracer::at(scene, origin, time)),
            points: VirtualTree::of_points(&lights, origin),
        }
    }

    /// Whether each round has lights of its own.
    #[must_use]
    pub fn differ(&self) -> bool {
        self.tracer.is_some()
    }

    /// A round; `None` where `proceed` says so.
    #[must_use]
    pub fn round(&self, number: u32, proceed: Proceed<'_>) -> Option<Round<'_>> {
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

    /// Traces the lights of a round; `frame` gathers from them from now on.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn light(&self, frame: &mut Frame, device: &Arc<Device>, number: u32) -> Result<()> {
        let Some(round) = self.round(number, &|| true) else { return Ok(()) };
        frame.set_gathered_lights(round.upload(device)?);
        Ok(())
    }

    /// Adds a round to the picture that `frame` rendered last, or what of it is left; what that took. Ends early, after a
    /// frame at least, where `proceed` says so.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn add(
        &self,
        frame: &mut Frame,
        device: &Arc<Device>,
        inputs: &FrameInputs<'_>,
        proceed: Proceed<'_>,
    ) -> Result<Timings> {
        let mut timings = Timings::default();
        if !frame.gathers().anything() {
            return Ok(timings);
        }
        let number = frame.gathered() / GATHER_FRAMES;
        if number == 0 || self.differ() {
            timings.add(&Timings::of("trace", || self.light(frame, device, number))?);
        }
        loop {
            timings.add(&frame.gather(inputs)?);
            if frame.gathered() / GATHER_FRAMES != number || !proceed() {
                return Ok(timings);
            }
        }
    }
}

impl Round<'_> {
    /// Lights that stand for reflected light.
    #[must_use]
    pub fn virtual_lights(&self) -> usize {
        self.virtuals.lights.len()
    }

    /// On the device.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn upload(&self, device: &Arc<Device>) -> Result<GatheredLights> {
        GatheredLights::new(device, [self.points, &self.emitters, &self.virtuals], self.spacing)
    }
}
