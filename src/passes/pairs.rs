//! Accounting: pairs of pixel and light, evaluated and useful. Outside the frame, only for reports and benchmarks.

use crate::error::Result;
use crate::gpu::{
    Buffer, BufferUse, ComputePipeline, DescriptorSet, DescriptorSets, Device, PipelineLayout,
    Specialization, Use, shaders,
};
use crate::gpu_scene::GpuScene;
use crate::shared::{self, TilePairs};
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

/// The counting pipeline and its buffer.
pub struct PairPass {
    pipeline: ComputePipeline,
    set: DescriptorSets,
    tiles: Buffer<TilePairs>,
}

impl PairPass {
    /// For a picture of so many tiles.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, tiles: u32) -> Result<Self> {
        let sets = [shared::frame::BINDINGS, shared::scene::BINDINGS, shared::pairs::BINDINGS];
        let layout = Arc::new(PipelineLayout::new(device, &sets)?);
        let tiles = Buffer::new(device, "pairs", BufferUse::Storage, tiles as usize)?;
        let set = layout.allocate(shared::pairs::SET, 1)?;
        set.get(0).buffer(shared::pairs::PAIRS_TILES, &tiles);
        let shader = shaders::CLUSTER_PAIRS_COMP;
        let pipeline = ComputePipeline::new(device, &layout, shader, &Specialization::default())?;
        Ok(Self { pipeline, set, tiles })
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
            cmd.bind_compute(&self.pipeline, &[frame, scene.set.get(0), self.set.get(0)]);
            cmd.dispatch([tiles[0], tiles[1], 1]);
            Ok(())
        })?;
        let sum = |pairs: PairCount, tile: &TilePairs| PairCount {
            evaluated: pairs.evaluated + u64::from(tile.evaluated),
            useful: pairs.useful + u64::from(tile.useful),
            area: pairs.area + u64::from(tile.area),
            area_all: pairs.area_all + u64::from(tile.area_all),
        };
        Ok(self.tiles.fetch(Use::ComputeWrite)?.iter().fold(PairCount::default(), sum))
    }
}
