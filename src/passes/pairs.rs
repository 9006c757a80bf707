//! Accounting: pairs of pixel and light, evaluated and useful. Outside the frame, only for reports and benchmarks.

use super::tally::Tally;
use crate::error::Result;
use crate::gpu::{ComputePipeline, DescriptorSet, Device, Specialization, Use, shaders};
use crate::gpu_scene::GpuScene;
use crate::shared::TilePairs;
use std::sync::Arc;

/// Pairs of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairCount {
    /// Evaluated by the shading.
    pub evaluated: u64,
    /// Within the light's range, or before an area light.
    pub useful: u64,
    /// Of area lights, among those evaluated.
    pub area: u64,
    /// Of area lights, had no mask left any out.
    pub area_all: u64,
}

/// The counting pipeline and its counters.
pub struct PairPass {
    pipeline: ComputePipeline,
    tally: Tally,
}

impl PairPass {
    /// For a picture of so many tiles.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, tiles: u32) -> Result<Self> {
        let tally = Tally::new(device, "pairs", tiles)?;
        let pipeline = tally.pipeline(device, shaders::CLUSTER_PAIRS_COMP, &Specialization::default())?;
        Ok(Self { pipeline, tally })
    }

    /// Counts the pairs of the picture last rendered.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn count(
        &self,
        device: &Arc<Device>,
        scene: &GpuScene,
        frame: DescriptorSet<'_>,
        tiles: [u32; 2],
    ) -> Result<PairCount> {
        device.run("pairs", |cmd| {
            cmd.memory_barrier(Use::ComputeWrite, Use::ComputeRead);
            cmd.bind_compute(&self.pipeline, &self.tally.sets(frame, scene));
            cmd.dispatch([tiles[0], tiles[1], 1]);
            Ok(())
        })?;
        let sum = |pairs: PairCount, tile: &TilePairs| PairCount {
            evaluated: pairs.evaluated + u64::from(tile.evaluated),
            useful: pairs.useful + u64::from(tile.useful),
            area: pairs.area + u64::from(tile.area),
            area_all: pairs.area_all + u64::from(tile.area_all),
        };
        Ok(self.tally.fetch()?.iter().fold(PairCount::default(), sum))
    }
}
