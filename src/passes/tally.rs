//! Counters of every tile, for compute outside the frame that looks at the picture last rendered.

use crate::error::Result;
use crate::gpu::{
    Buffer, BufferUse, ComputePipeline, DescriptorSet, DescriptorSets, Device, PipelineLayout, Shader,
    Specialization, Use,
};
use crate::gpu_scene::GpuScene;
use crate::shared::{self, TilePairs};
use std::sync::Arc;

/// A buffer of counters, and the layout of the pipelines that fill it.
pub(super) struct Tally {
    layout: Arc<PipelineLayout>,
    set: DescriptorSets,
    tiles: Buffer<TilePairs>,
}

impl Tally {
    /// Room for so many tiles.
    pub(super) fn new(device: &Arc<Device>, name: &'static str, tiles: u32) -> Result<Self> {
        let sets = [shared::frame::BINDINGS, shared::scene::BINDINGS, shared::pairs::BINDINGS];
        let layout = Arc::new(PipelineLayout::new(device, &sets)?);
        let tiles = Buffer::new(device, name, BufferUse::Storage, tiles as usize)?;
        let set = layout.allocate(shared::pairs::SET, 1)?;
        set.get(0).buffer(shared::pairs::PAIRS_TILES, &tiles);
        Ok(Self { layout, set, tiles })
    }

    /// A pipeline that fills it.
    pub(super) fn pipeline(
        &self,
        device: &Arc<Device>,
        shader: Shader,
        specialization: &Specialization,
    ) -> Result<ComputePipeline> {
        ComputePipeline::new(device, &self.layout, shader, specialization)
    }

    /// What such a pipeline is bound with.
    pub(super) fn sets<'a>(
        &'a self,
        frame: DescriptorSet<'a>,
        scene: &'a GpuScene,
    ) -> [DescriptorSet<'a>; 3] {
        [frame, scene.set.get(0), self.set.get(0)]
    }

    /// The counters.
    pub(super) fn fetch(&self) -> Result<Vec<TilePairs>> {
        self.tiles.fetch(Use::ComputeWrite)
    }
}
