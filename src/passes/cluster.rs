//! Compute: from depth to the light list of each occupied cluster.
//!
//! 1. `slices`: which depth slices each tile's pixels lie in.
//! 2. `scan_tiles`: ids for the occupied (tile, slice) pairs, the clusters.
//! 3. `bounds`: each pixel's cluster id; each cluster's box of samples.
//! 4. `area`: which area lights reach each cluster, one bit each, in the texels before the lists.
//! 5. `count`: lights that reach each cluster, by a walk over the light tree.
//! 6. `scan_lists`: where each list lies.
//! 7. `write`: the lists, in Hilbert order, four indices a texel.
//! 8. `cut_count`, `scan_cuts`, `cut_write`: the same for the nodes that stand for lights without a range.
//!
//! Ids and lists come from scans, never from atomics, so they are the same on every run. Step 4 is recorded only where the
//! scene has many area lights, steps 5 to 7 where it has lights with a range, step 8 where it has many without, and the
//! others where it has any of these.

use super::forward::Work;
use super::{PassInputs, View};
use crate::error::{Error, Result};
use crate::gpu::{
    Buffer, BufferUse, Commands, ComputePipeline, DescriptorSet, Device, Format, Image, ImageDescription,
    Shader, Specialization, Use, shaders,
};
use crate::shared::{self, Cluster, Counters, LIST_HEIGHT_LOG2, LIST_WIDTH_LOG2, Tile};
use std::sync::Arc;

/// Array layers that every device has: 2 GiB of lists.
const MAX_LAYERS: u32 = 256;

/// Room for clusters, their masks and lists; grows when a frame needs more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Clusters.
    pub clusters: u32,
    /// Texels of a cluster's mask of area lights.
    pub mask: u32,
    /// Texels of masks and lists.
    pub texels: u32,
}

impl Capacity {
    /// What a picture of so many tiles starts with: two depth layers, 64 lights in each.
    #[must_use]
    pub fn start(tiles: u32, mask: u32) -> Self {
        let room = Self { clusters: tiles.max(32) * 2, mask, texels: 0 };
        room.with_texels(room.masks() + u64::from(tiles) * 32)
    }

    fn masks(self) -> u64 {
        u64::from(self.clusters) * u64::from(self.mask)
    }

    /// Whole layers of the list image.
    fn with_texels(self, texels: u64) -> Self {
        let layer = 1 << (LIST_WIDTH_LOG2 + LIST_HEIGHT_LOG2);
        // More than fits in 32 bits no device has: the image of the lists says so.
        let layers = texels.div_ceil(u64::from(layer)).clamp(1, u64::from(u32::MAX / layer));
        Self { texels: layers as u32 * layer, ..self }
    }

    /// Enough for what the counters ask for; `None` if it is so already.
    #[must_use]
    pub fn grown(self, counters: &Counters) -> Option<Self> {
        // Where clusters were missing, so were their lists: the texels needed are known only next time.
        let larger = Self { clusters: counters.clusters.max(self.clusters), ..self };
        let lists = u64::from(counters.list_texels).max(u64::from(self.texels)) - self.masks();
        let larger = larger.with_texels(larger.masks() + lists);
        (larger != self).then_some(larger)
    }
}

/// What the pass writes.
pub struct ClusterTargets {
    /// How much fits.
    pub capacity: Capacity,
    /// Slices of each tile.
    pub tiles: Buffer<Tile>,
    /// Boxes and lists of clusters.
    pub clusters: Buffer<Cluster>,
    /// Sums.
    pub counters: Buffer<Counters>,
    /// The lists.
    pub lists: Image,
}

impl ClusterTargets {
    /// Makes the buffers, and leaves the lists ready to be written.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, tiles: u32, capacity: Capacity) -> Result<Self> {
        let layers = capacity.texels >> (LIST_WIDTH_LOG2 + LIST_HEIGHT_LOG2);
        if layers > MAX_LAYERS {
            return Err(Error::Vulkan {
                call: "light lists".into(),
                result: format!("they need {layers} array layers, and devices have {MAX_LAYERS}"),
                remedy:
                    "lower render.max_lights_per_cluster, use fewer area lights, or render a smaller picture"
                        .into(),
            });
        }
        let lists = Image::new(
            device,
            &ImageDescription {
                name: "light lists",
                format: Format::R32G32B32A32_UINT,
                size: [1 << LIST_WIDTH_LOG2, 1 << LIST_HEIGHT_LOG2],
                layers: Some(layers),
                mips: 1,
                uses: &[Use::ComputeWrite, Use::FragmentRead, Use::TransferRead],
            },
        )?;
        device.run("prepare light lists", |cmd| {
            cmd.transition(&lists, Use::Nothing, Use::FragmentRead);
            Ok(())
        })?;
        Ok(Self {
            capacity,
            tiles: Buffer::new(device, "tiles", BufferUse::Storage, tiles as usize)?,
            clusters: Buffer::new(device, "clusters", BufferUse::Storage, capacity.clusters as usize)?,
            counters: Buffer::new(device, "cluster counters", BufferUse::Storage, 1)?,
            lists,
        })
    }

    /// Puts the buffers into the frame's set.
    pub fn bind(&self, frame: DescriptorSet<'_>) {
        frame.buffer(shared::frame::FRAME_TILES, &self.tiles);
        frame.buffer(shared::frame::FRAME_CLUSTERS, &self.clusters);
        frame.buffer(shared::frame::FRAME_COUNTERS, &self.counters);
        frame.image(shared::frame::FRAME_LISTS_OUT, &self.lists, Use::ComputeWrite);
        frame.image(shared::frame::FRAME_LISTS, &self.lists, Use::FragmentRead);
    }
}

/// The pass's pipelines.
pub struct ClusterPass {
    slices: ComputePipeline,
    scan_tiles: ComputePipeline,
    bounds: ComputePipeline,
    lists: Option<Lists>,
    cuts: Option<Lists>,
    area: Option<ComputePipeline>,
}

/// Those of lists or cuts.
struct Lists {
    count: ComputePipeline,
    scan: ComputePipeline,
    write: ComputePipeline,
}

impl Lists {
    fn record(&self, cmd: &mut Commands, sets: &[DescriptorSet<'_>], counters: &Buffer<Counters>) {
        cmd.bind_compute(&self.count, sets);
        cmd.dispatch_indirect(counters);
        cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
        cmd.bind_compute(&self.scan, sets);
        cmd.dispatch([1, 1, 1]);
        cmd.memory_barrier(Use::ComputeWrite, Use::IndirectRead);
        cmd.bind_compute(&self.write, sets);
        cmd.dispatch_indirect(counters);
    }
}

impl ClusterPass {
    /// Compiles the steps: lists for lights with a range, cuts for those without, masks for area lights.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, work: Work) -> Result<Self> {
        let step = |shader| {
            ComputePipeline::new(inputs.device, &inputs.scene.layout, shader, &Specialization::default())
        };
        let steps = |[count, scan, write]: [Shader; 3]| -> Result<Lists> {
            Ok(Lists { count: step(count)?, scan: step(scan)?, write: step(write)? })
        };
        let lists =
            [shaders::CLUSTER_COUNT_COMP, shaders::CLUSTER_SCAN_LISTS_COMP, shaders::CLUSTER_WRITE_COMP];
        let cuts = [
            shaders::CLUSTER_CUT_COUNT_COMP,
            shaders::CLUSTER_SCAN_CUTS_COMP,
            shaders::CLUSTER_CUT_WRITE_COMP,
        ];
        Ok(Self {
            slices: step(shaders::CLUSTER_SLICES_COMP)?,
            scan_tiles: step(shaders::CLUSTER_SCAN_TILES_COMP)?,
            bounds: step(shaders::CLUSTER_BOUNDS_COMP)?,
            lists: work.lists.then(|| steps(lists)).transpose()?,
            cuts: work.cut.then(|| steps(cuts)).transpose()?,
            area: work.masks.then(|| step(shaders::CLUSTER_AREA_COMP)).transpose()?,
        })
    }

    /// Records the steps, with what each hands to the next.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>, targets: &ClusterTargets, tiles: [u32; 2]) {
        let sets = [view.frame, view.scene.set.get(0)];
        let tiles = [tiles[0], tiles[1], 1];
        cmd.labelled("cluster", |cmd| {
            cmd.bind_compute(&self.slices, &sets);
            cmd.dispatch(tiles);
            cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
            cmd.bind_compute(&self.scan_tiles, &sets);
            cmd.dispatch([1, 1, 1]);
            cmd.memory_barrier(Use::ComputeWrite, Use::IndirectRead);
            cmd.bind_compute(&self.bounds, &sets);
            cmd.dispatch(tiles);
            cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
            if let Some(area) = &self.area {
                cmd.bind_compute(area, &sets);
                cmd.dispatch_indirect(&targets.counters);
                cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
            }
            if let Some(lists) = &self.lists {
                lists.record(cmd, &sets, &targets.counters);
            }
            if let Some(cuts) = &self.cuts {
                // They lie behind the lists, and use the same counters.
                cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
                cuts.record(cmd, &sets, &targets.counters);
            }
        });
    }
}
