//! Compute: from depth to the light list of each occupied cluster.
//!
//! 1. `slices`: which depth slices each tile's pixels lie in; of far tiles, each quadrant's.
//! 2. `bands`: how many clusters each block of 4 × 4 tiles has in each band of 8 slices.
//! 3. `scan_tiles`: a parent for each block and band that has clusters, and ids for these.
//! 4. `bounds`: each pixel's cluster id; each cluster's box of samples.
//! 5. `area`: which area lights reach each cluster, one bit each, in the texels before the lists.
//! 6. `gather`: the lights that reach each parent, by a walk over the light tree. Where a parent's list would be too long,
//!    `split` makes parents of its children, and these are gathered.
//! 7. `count`: which lights of its parent's list reach each cluster, kept as masks.
//! 8. `scan_lists`: where each list lies.
//! 9. `write`: the lists, in Hilbert order, four indices a texel, from the masks.
//! 10. `fold`: lists longer than the cap.
//! 11. `cut_count`: how many nodes of their tree stand for lights without a range.
//! 12. `scan_cuts`: where each cut lies.
//! 13. `cut_write`: the cuts.
//!
//! Ids and lists come from scans, never from atomics, so they are the same on every run. Step 5 is recorded only where the
//! scene has many area lights, steps 6 to 9 where it has lights with a range, step 10 once a
//! frame has needed it, steps 11 to 13 where it has many without, and the others where it has any of these.

mod capacity;

use super::forward::Work;
use super::{PassInputs, View};
use crate::error::{Error, Result};
use crate::gpu::{
    Buffer, BufferUse, Commands, ComputePipeline, DescriptorSet, Device, Format, Image, ImageDescription,
    Specialization, Use, shaders,
};
use crate::shared::{self, Cluster, Counters, LIST_HEIGHT_LOG2, LIST_WIDTH_LOG2, TILE_SIZE, Tile};
use capacity::{MAX_LAYERS, area, blocks};
use std::sync::Arc;

pub use capacity::Capacity;

/// Words of [`Counters`] where dispatches over clusters, parents and folded clusters begin.
const OF_CLUSTERS: u32 = 0;
const OF_PARENTS: u32 = 3;
const OF_FOLDS: u32 = 6;

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

/// The pass's pipelines.
pub struct ClusterPass {
    slices: ComputePipeline,
    bands: ComputePipeline,
    scan_tiles: ComputePipeline,
    bounds: ComputePipeline,
    lists: Option<Lists>,
    cuts: Option<Cuts>,
    area: Option<ComputePipeline>,
    /// Tiles that a workgroup of `slices` and `bounds` takes.
    tiles: u32,
}

/// Those of lists.
struct Lists {
    gather: ComputePipeline,
    split: ComputePipeline,
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
    /// wants to know which pixels and variants a cluster has, a step that folds which pixels.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, work: Work) -> Result<Self> {
        let Work { lists, masks, resolve, cut, folded, .. } = work;
        let with = |shader, specialization: &Specialization| {
            ComputePipeline::new(inputs.device, &inputs.scene.layout, shader, specialization)
        };
        let step = |shader| with(shader, &Specialization::default());
        let lanes = Specialization::default().with(shared::SPEC_LANES, inputs.lanes);
        let of_lists = || -> Result<Lists> {
            Ok(Lists {
                gather: with(shaders::CLUSTER_GATHER_COMP, &lanes)?,
                count: step(shaders::CLUSTER_COUNT_COMP)?,
                scan_lists: step(shaders::CLUSTER_SCAN_LISTS_COMP)?,
                write: step(shaders::CLUSTER_WRITE_COMP)?,
                split: step(shaders::CLUSTER_SPLIT_COMP)?,
                fold: folded.then(|| of_fold(inputs)).transpose()?,
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
        let notes = lanes
            .clone()
            .with(shared::SPEC_NOTE_PIXELS, u32::from(resolve || cut || folded))
            .with(shared::SPEC_NOTE_VARIANTS, u32::from(resolve));
        Ok(Self {
            slices: with(shaders::CLUSTER_SLICES_COMP, &lanes)?,
            bands: step(shaders::CLUSTER_BANDS_COMP)?,
            scan_tiles: step(shaders::CLUSTER_SCAN_TILES_COMP)?,
            bounds: with(shaders::CLUSTER_BOUNDS_COMP, &notes)?,
            lists: lists.then(of_lists).transpose()?,
            cuts: cut.then(of_cuts).transpose()?,
            area: masks.then(|| step(shaders::CLUSTER_AREA_COMP)).transpose()?,
            tiles: inputs.lanes / TILE_SIZE,
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
        let by_tiles = [tiles[0].div_ceil(self.tiles), tiles[1], 1];
        let next = |cmd: &mut Commands| cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
        cmd.labelled("cluster", |cmd| {
            cmd.bind_compute(&self.slices, &sets);
            cmd.dispatch(by_tiles);
            next(cmd);
            cmd.bind_compute(&self.bands, &sets);
            cmd.dispatch(flat(blocks(tiles)));
            next(cmd);
            cmd.bind_compute(&self.scan_tiles, &sets);
            cmd.dispatch([1, 1, 1]);
            cmd.memory_barrier(Use::ComputeWrite, Use::IndirectRead);
            next(cmd);
            cmd.bind_compute(&self.bounds, &sets);
            cmd.dispatch(by_tiles);
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
            (&self.split, None),
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

/// The step that folds lists.
fn of_fold(inputs: &PassInputs<'_>) -> Result<ComputePipeline> {
    let matte = (shared::SPEC_MODEL, shared::MODEL_MATTE);
    let glossy = inputs.scene.variants.iter().any(|it| !it.specialization.values().contains(&matte));
    let specialization = Specialization::default()
        .with(shared::SPEC_GLOSSY, u32::from(glossy))
        .with(shared::SPEC_LANES, fold_lanes(inputs.lanes, inputs.scene.lights.ranged));
    ComputePipeline::new(inputs.device, &inputs.scene.layout, shaders::CLUSTER_FOLD_COMP, &specialization)
}

/// Invocations that fold a list. With `2¹⁵` lights each at most no loop has more iterations than lavapipe runs; more of them
/// than a vector has cost it their part in every sum.
fn fold_lanes(lanes: u32, ranged: usize) -> u32 {
    let needed = ranged.div_ceil(1 << 15).next_power_of_two() as u32;
    needed.max(lanes).min(shared::FOLD_LANES)
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
