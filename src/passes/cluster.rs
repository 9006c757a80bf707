//! Compute: from depth to the light list of each occupied cluster.
//!
//! 1. `slices`: which depth slices each tile's pixels lie in; of far tiles, each quadrant's.
//! 2. `bands`: how many clusters each block of 4 × 4 tiles has in each band of 8 slices.
//! 3. `scan_tiles`: a parent for each block and band that has clusters, and ids for these.
//! 4. `bounds`: each pixel's cluster id; each cluster's box of samples.
//! 5. `area`: which area lights reach each cluster, one bit each, in the texels before the lists.
//! 6. `gather`: the lights that reach each parent, by a walk over the light tree.
//! 7. `count`: which lights of its parent's list reach each cluster, kept as masks.
//! 8. `scan_lists`: where each list lies.
//! 9. `write`: the lists, in Hilbert order, four indices a texel, from the masks.
//! 10. `fold`: lists longer than the cap, and those of crowded parents.
//! 11. `cut_count`: how many nodes of their tree stand for lights without a range.
//! 12. `scan_cuts`: where each cut lies.
//! 13. `cut_write`: the cuts.
//!
//! Ids and lists come from scans, never from atomics, so they are the same on every run. Step 5 is recorded only where the
//! scene has many area lights, steps 6 to 9 where it has lights with a range, step 10 once a
//! frame has needed it, steps 11 to 13 where it has many without, and the others where it has any of these.

use super::forward::Work;
use super::{PassInputs, View};
use crate::error::{Error, Result};
use crate::gpu::{
    Buffer, BufferUse, Commands, ComputePipeline, DescriptorSet, Device, Format, Image, ImageDescription,
    Specialization, Use, shaders,
};
use crate::shared::{
    self, BLOCK_TILES, Cluster, Counters, LEAF_LIGHTS, LINEAR_GROUP, LIST_HEIGHT_LOG2, LIST_WIDTH_LOG2,
    PARENT_ROOM, SIBLINGS, Tile,
};
use std::sync::Arc;

/// Array layers that every device has: 2 GiB of lists.
const MAX_LAYERS: u32 = 256;

/// Words of [`Counters`] where dispatches over clusters, parents and folded clusters begin.
const OF_CLUSTERS: u32 = 0;
const OF_PARENTS: u32 = 3;
const OF_FOLDS: u32 = 6;

/// Room for clusters, their parents, masks and lists; grows when a frame needs more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Clusters, a multiple of `LINEAR_GROUP`.
    pub clusters: u32,
    /// Parents; 0 where there are no lists.
    pub parents: u32,
    /// Texels of a cluster's mask of area lights.
    pub mask: u32,
    /// Texels of masks and lists.
    pub texels: u32,
    /// Step 10 has lists to make.
    pub folds: bool,
    /// Some of them end in nodes of folded lights.
    pub nodes: bool,
}

impl Capacity {
    /// What a picture of so many tiles starts with: two depth layers, 64 lights in each.
    #[must_use]
    pub fn start(tiles: [u32; 2], lists: bool, mask: u32) -> Self {
        let clusters = (area(tiles).max(32) * 2).next_multiple_of(LINEAR_GROUP);
        let parents = if lists { 4 * area(blocks(tiles)) } else { 0 };
        let room = Self { clusters, parents, mask, texels: 0, folds: false, nodes: false };
        room.with_texels(room.first_texels()[2] + u64::from(area(tiles)) * 32)
    }

    /// Where the lists of parents, the masks of their children and the lists of clusters begin. Masks of area lights come
    /// before them.
    #[must_use]
    pub fn first_texels(self) -> [u64; 3] {
        let parents = u64::from(self.clusters) * u64::from(self.mask);
        let masks = parents + u64::from(self.parents) * u64::from(PARENT_ROOM / 4);
        let siblings = if self.parents > 0 { u64::from(self.clusters / SIBLINGS) } else { 0 };
        [parents, masks, masks + siblings * u64::from(PARENT_ROOM / LEAF_LIGHTS)]
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
        let clusters = counters.clusters.max(self.clusters).next_multiple_of(LINEAR_GROUP);
        let parents = if self.parents > 0 { counters.parents.max(self.parents) } else { 0 };
        let folds = self.folds || counters.folding > 0;
        let nodes = self.nodes || counters.overflowed > 0;
        let larger = Self { clusters, parents, folds, nodes, ..self };
        // Where clusters were missing, so were their lists: the texels needed are known only next time.
        let lists = u64::from(counters.list_texels.max(self.texels)) - self.first_texels()[2];
        let larger = larger.with_texels(larger.first_texels()[2] + lists);
        (larger != self).then_some(larger)
    }
}

/// What the pass writes.
pub struct ClusterTargets {
    /// How much fits.
    pub capacity: Capacity,
    /// Slices of each tile, then of each block.
    pub tiles: Buffer<Tile>,
    /// Boxes and lists of clusters, then of their parents.
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
    pub fn new(device: &Arc<Device>, tiles: [u32; 2], capacity: Capacity) -> Result<Self> {
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
            tiles: Buffer::new(
                device,
                "tiles",
                BufferUse::Storage,
                (area(tiles) + area(blocks(tiles))) as usize,
            )?,
            clusters: Buffer::new(
                device,
                "clusters",
                BufferUse::Storage,
                (capacity.clusters + capacity.parents) as usize,
            )?,
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

/// Blocks of tiles, across and down.
fn blocks(tiles: [u32; 2]) -> [u32; 2] {
    tiles.map(|side| side.div_ceil(BLOCK_TILES))
}

fn area([x, y]: [u32; 2]) -> u32 {
    x * y
}

/// The pass's pipelines.
pub struct ClusterPass {
    slices: ComputePipeline,
    bands: ComputePipeline,
    scan_tiles: ComputePipeline,
    bounds: ComputePipeline,
    lists: Option<Lists>,
    cuts: Option<Cuts>,
    area: Option<ComputePipeline>,
}

/// Those of lists.
struct Lists {
    gather: ComputePipeline,
    count: ComputePipeline,
    scan_lists: ComputePipeline,
    write: ComputePipeline,
    fold: Option<ComputePipeline>,
}

/// Those of cuts.
struct Cuts {
    count: ComputePipeline,
    scan: ComputePipeline,
    write: ComputePipeline,
    given_up: ComputePipeline,
}

impl ClusterPass {
    /// Compiles the steps: lists for lights with a range, which may have to be folded; masks for area lights. A resolve
    /// wants to know which pixels and variants a cluster has.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, work: Work, folds: bool) -> Result<Self> {
        let Work { lists, masks, resolve, cut, .. } = work;
        let step = |shader| {
            ComputePipeline::new(inputs.device, &inputs.scene.layout, shader, &Specialization::default())
        };
        let of_lists = || -> Result<Lists> {
            Ok(Lists {
                gather: step(shaders::CLUSTER_GATHER_COMP)?,
                count: step(shaders::CLUSTER_COUNT_COMP)?,
                scan_lists: step(shaders::CLUSTER_SCAN_LISTS_COMP)?,
                write: step(shaders::CLUSTER_WRITE_COMP)?,
                fold: folds.then(|| step(shaders::CLUSTER_FOLD_COMP)).transpose()?,
            })
        };
        let of_cuts = || -> Result<Cuts> {
            Ok(Cuts {
                count: step(shaders::CLUSTER_CUT_COUNT_COMP)?,
                scan: step(shaders::CLUSTER_SCAN_CUTS_COMP)?,
                write: step(shaders::CLUSTER_CUT_WRITE_COMP)?,
                given_up: step(shaders::CLUSTER_GIVEN_UP_COMP)?,
            })
        };
        let notes = Specialization::default()
            .with(shared::SPEC_NOTE_PIXELS, u32::from(resolve || cut))
            .with(shared::SPEC_NOTE_VARIANTS, u32::from(resolve));
        Ok(Self {
            slices: step(shaders::CLUSTER_SLICES_COMP)?,
            bands: step(shaders::CLUSTER_BANDS_COMP)?,
            scan_tiles: step(shaders::CLUSTER_SCAN_TILES_COMP)?,
            bounds: ComputePipeline::new(
                inputs.device,
                &inputs.scene.layout,
                shaders::CLUSTER_BOUNDS_COMP,
                &notes,
            )?,
            lists: lists.then(of_lists).transpose()?,
            cuts: cut.then(of_cuts).transpose()?,
            area: masks.then(|| step(shaders::CLUSTER_AREA_COMP)).transpose()?,
        })
    }

    /// Behind the picture, its colour in use [`Use::ComputeRead`]: counts the pixels whose cuts were given up.
    pub fn record_given_up(&self, cmd: &mut Commands, view: &View<'_>, [x, y]: [u32; 2]) {
        let Some(cuts) = &self.cuts else { return };
        cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
        cmd.bind_compute(&cuts.given_up, &[view.frame, view.scene.set.get(0)]);
        cmd.dispatch([x, y, 1]);
    }

    /// Records the steps, with what each hands to the next.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>, targets: &ClusterTargets, tiles: [u32; 2]) {
        let sets = [view.frame, view.scene.set.get(0)];
        let flat = |[x, y]: [u32; 2]| [x, y, 1];
        let next = |cmd: &mut Commands| cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
        cmd.labelled("cluster", |cmd| {
            cmd.bind_compute(&self.slices, &sets);
            cmd.dispatch(flat(tiles));
            next(cmd);
            cmd.bind_compute(&self.bands, &sets);
            cmd.dispatch(flat(blocks(tiles)));
            next(cmd);
            cmd.bind_compute(&self.scan_tiles, &sets);
            cmd.dispatch([1, 1, 1]);
            cmd.memory_barrier(Use::ComputeWrite, Use::IndirectRead);
            next(cmd);
            cmd.bind_compute(&self.bounds, &sets);
            cmd.dispatch(flat(tiles));
            if let Some(area) = &self.area {
                next(cmd);
                cmd.bind_compute(area, &sets);
                cmd.dispatch_indirect(&targets.counters, OF_CLUSTERS);
            }
            if let Some(lists) = &self.lists {
                lists.record(cmd, &sets, targets);
            }
            if let Some(cuts) = &self.cuts {
                cuts.record(cmd, &sets, targets);
            }
        });
    }
}

impl Lists {
    fn record(&self, cmd: &mut Commands, sets: &[DescriptorSet<'_>], targets: &ClusterTargets) {
        let steps = [
            (&self.gather, Some(OF_PARENTS)),
            (&self.count, Some(OF_CLUSTERS)),
            (&self.scan_lists, None),
            (&self.write, Some(OF_CLUSTERS)),
        ];
        let fold = self.fold.iter().map(|fold| (fold, Some(OF_FOLDS)));
        record_steps(cmd, sets, targets, steps.into_iter().chain(fold));
    }
}

impl Cuts {
    fn record(&self, cmd: &mut Commands, sets: &[DescriptorSet<'_>], targets: &ClusterTargets) {
        let steps = [(&self.count, Some(OF_CLUSTERS)), (&self.scan, None), (&self.write, Some(OF_CLUSTERS))];
        record_steps(cmd, sets, targets, steps);
    }
}

/// Records steps, each with the words of the counters that say of how many workgroups, or with one.
fn record_steps<'a>(
    cmd: &mut Commands,
    sets: &[DescriptorSet<'_>],
    targets: &ClusterTargets,
    steps: impl IntoIterator<Item = (&'a ComputePipeline, Option<u32>)>,
) {
    for (step, groups) in steps {
        // The scans write the counters, where the dispatches' sizes are.
        cmd.memory_barrier(Use::ComputeWrite, Use::IndirectRead);
        cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
        cmd.bind_compute(step, sets);
        match groups {
            Some(groups) => cmd.dispatch_indirect(&targets.counters, groups),
            None => cmd.dispatch([1, 1, 1]),
        }
    }
}
