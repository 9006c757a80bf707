//! The device's floors: what a pair of pixel and light costs at least, over the lists of the picture last rendered.

use super::tally::Tally;
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Specialization, Timestamps, Use, shaders};
use crate::gpu_scene::GpuScene;
use crate::shared;
use cpu_time::ProcessTime;
use serde::Serialize;
use std::sync::Arc;

/// Runs of each loop; the median counts.
const RUNS: usize = 5;

/// Nanoseconds a pair, one pixel an invocation; on a CPU device of CPU time, else of device time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Floors {
    /// Arithmetic only, Lambert.
    pub lambert_arithmetic: f64,
    /// Arithmetic only, Trowbridge–Reitz and Lambert (plastic).
    pub plastic_arithmetic: f64,
    /// Fetches only: a quarter of a texel of indices, two texels of the light.
    pub fetch: f64,
    /// Both, Lambert.
    pub lambert: f64,
    /// Both, plastic.
    pub plastic: f64,
}

impl std::fmt::Display for Floors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { lambert_arithmetic, plastic_arithmetic, fetch, lambert, plastic } = self;
        write!(
            f,
            "floors, ns a pair: arithmetic {lambert_arithmetic:.2} (Lambert), {plastic_arithmetic:.2} (plastic), fetch \
             {fetch:.2}, both {lambert:.2}, {plastic:.2}"
        )
    }
}

/// The loops and what they need.
pub struct FloorPass {
    device: Arc<Device>,
    tally: Tally,
    timestamps: Timestamps,
}

impl FloorPass {
    /// For a picture of so many tiles.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, tiles: u32) -> Result<Self> {
        let tally = Tally::new(device, "floors", tiles)?;
        Ok(Self { device: device.clone(), tally, timestamps: Timestamps::new(device, 2)? })
    }

    /// Measures; `None` where the lists are empty.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn measure(
        &self,
        scene: &GpuScene,
        frame: DescriptorSet<'_>,
        tiles: [u32; 2],
    ) -> Result<Option<Floors>> {
        let time = |floor, model| self.time(scene, frame, tiles, [floor, model]);
        let nothing = time(shared::FLOOR_NOTHING, shared::MODEL_MATTE)?;
        let pairs: u64 = self.tally.fetch()?.iter().map(|tile| u64::from(tile.evaluated)).sum();
        if pairs == 0 {
            return Ok(None);
        }
        let ns = |floor, model| -> Result<f64> {
            Ok((time(floor, model)? - nothing).max(0.0) * 1e6 / pairs as f64)
        };
        Ok(Some(Floors {
            lambert_arithmetic: ns(shared::FLOOR_ARITHMETIC, shared::MODEL_MATTE)?,
            plastic_arithmetic: ns(shared::FLOOR_ARITHMETIC, shared::MODEL_PLASTIC)?,
            fetch: ns(shared::FLOOR_FETCH, shared::MODEL_MATTE)?,
            lambert: ns(shared::FLOOR_BOTH, shared::MODEL_MATTE)?,
            plastic: ns(shared::FLOOR_BOTH, shared::MODEL_PLASTIC)?,
        }))
    }

    /// Milliseconds of one loop.
    fn time(
        &self,
        scene: &GpuScene,
        frame: DescriptorSet<'_>,
        tiles: [u32; 2],
        [floor, model]: [u32; 2],
    ) -> Result<f64> {
        let specialization =
            Specialization::default().with(shared::SPEC_FLOOR, floor).with(shared::SPEC_MODEL, model);
        let pipeline = self.tally.pipeline(&self.device, shaders::CLUSTER_FLOORS_COMP, &specialization)?;
        let run = || -> Result<f64> {
            let begin = ProcessTime::now();
            self.device.run("floors", |cmd| {
                cmd.reset_timestamps(&self.timestamps);
                cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
                cmd.timestamp(&self.timestamps, 0);
                cmd.bind_compute(&pipeline, &self.tally.sets(frame, scene));
                cmd.dispatch([tiles[0], tiles[1], 1]);
                cmd.timestamp(&self.timestamps, 1);
                Ok(())
            })?;
            let cpu = begin.elapsed().as_secs_f64() * 1e3;
            let device = self.timestamps.intervals()?.map_or(cpu, |intervals| intervals[0]);
            Ok(if self.device.is_cpu() { cpu } else { device })
        };
        run()?; // the first may still compile
        let mut times = (0..RUNS).map(|_| run()).collect::<Result<Vec<_>>>()?;
        times.sort_by(f64::total_cmp);
        Ok(times[RUNS / 2])
    }
}
