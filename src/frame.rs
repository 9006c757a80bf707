//! The frame: its passes in order, and the barriers between them, top to bottom.
//!
//! prepass → cluster → resolve → forward (direct → indirect → present)

mod adopt;
mod constants;
mod cut;
mod encoded;
mod gather;
mod pick;
mod results;
mod retune;
mod room;
mod settings;
mod timing;
mod views;
mod work;

pub use settings::{FrameInputs, FrameSettings};
pub use timing::{PassTime, Timings};

use crate::draws::VisibleDraw;
use crate::error::Result;
use crate::gpu::{Buffer, BufferUse, Commands, DescriptorSets, Device, Timestamps, Use};
use crate::gpu_scene::GpuScene;
use crate::passes::cluster::{Capacity, ClusterPass, ClusterTargets};
use crate::passes::forward::{Forward, Sample, Work};
use crate::passes::gather::{Gather, GatheredLights};
use crate::passes::prepass::Prepass;
use crate::passes::resolve::Resolve;
use crate::passes::{PassInputs, View};
use crate::shared::{self, Counters, FrameConstants};
use crate::targets::Targets;
use std::sync::Arc;
use timing::Stopwatch;
use work::{clustered, pass_names, work};

/// A scene's frame on a device.
pub struct Frame {
    device: Arc<Device>,
    scene: Arc<GpuScene>,
    settings: FrameSettings,
    work: Work,
    targets: Targets,
    prepass: Prepass,
    cluster: Option<ClusterPass>,
    resolve: Option<Resolve>,
    forward: Forward,
    gather: Option<Gather>,
    gathered_lights: Option<GatheredLights>,
    lists: ClusterTargets,
    constants: Buffer<FrameConstants>,
    set: DescriptorSets,
    readback: Buffer<Counters>,
    counters: Counters,
    timestamps: Timestamps,
    pass_names: Vec<&'static str>,
    samples: u32,
    // Frames of gathered light, and rows of the next one.
    gathered: u32,
    gathered_rows: u32,
    // Samples have point lights whose light is gathered.
    previews: bool,
    slices: u32,
    // Of the sample last rendered.
    last: FrameConstants,
    draws: Vec<VisibleDraw>,
    luminaires: Vec<VisibleDraw>,
}

impl Frame {
    /// Compiles the passes that the scene needs and makes their targets.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, scene: &Arc<GpuScene>, settings: FrameSettings) -> Result<Self> {
        Self::of(device, scene, settings, work(device, scene, &settings))
    }

    fn of(device: &Arc<Device>, scene: &Arc<GpuScene>, settings: FrameSettings, work: Work) -> Result<Self> {
        let inputs = pass_inputs(device, scene, &settings);
        let targets = Targets::new(device, settings.size, [work.resolve, work.cut], settings.encoding)?;
        let tiles = tiles_of(settings.size);
        let pass_names = pass_names(work);
        let mask = if work.masks { work.area.div_ceil(shared::AREA_MASK_LIGHTS) } else { 0 };
        let capacity = Capacity::start(tiles, work.lists, mask);
        // Side by side: most of a start is the driver's work on these pipelines.
        let ((prepass, cluster), (resolve, forward)) = rayon::join(
            || {
                let cluster = || ClusterPass::new(&inputs, work);
                let prepass = Prepass::new(&inputs, &targets, work.resolve);
                (prepass, clustered(work).then(cluster).transpose())
            },
            || {
                let resolve = || Resolve::new(&inputs, &targets, work.folded, capacity.clusters);
                let forward = Forward::new(&inputs, &targets, work);
                (work.resolve.then(resolve).transpose(), forward)
            },
        );
        let frame = Self {
            prepass: prepass?,
            cluster: cluster?,
            resolve: resolve?,
            forward: forward?,
            gather: gather::pass(&inputs, &targets, work.gathered)?,
            gathered_lights: None,
            lists: ClusterTargets::new(device, tiles, capacity)?,
            constants: Buffer::new(device, "frame constants", BufferUse::Uniform, 1)?,
            set: scene.layout.allocate(shared::frame::SET, 1)?,
            readback: Buffer::new(device, "counters readback", BufferUse::Readback, 1)?,
            counters: Counters::default(),
            timestamps: Timestamps::new(device, pass_names.len() as u32 + 1)?,
            pass_names,
            samples: 0,
            gathered: 0,
            gathered_rows: 0,
            previews: false,
            slices: 0,
            last: FrameConstants::default(),
            draws: Vec::new(),
            luminaires: Vec::new(),
            targets,
            device: device.clone(),
            scene: scene.clone(),
            settings,
            work,
        };
        frame.bind();
        Ok(frame)
    }

    /// Renders a picture; it stays on the device until it is fetched.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn render(&mut self, inputs: &FrameInputs<'_>) -> Result<Timings> {
        let lights = self.move_lights(inputs.time)?;
        // A frame that needs more room for clusters than any before it is rendered again: no picture lacks light
        // because a buffer was too small.
        loop {
            if let Some(timings) = self.accumulate(inputs)? {
                return Ok(timings.after(lights));
            }
        }
    }

    /// Adds the next sample to the picture: what [`Frame::render`] does at once, step by step. The first sample is number 0 of
    /// `inputs.samples`; [`Frame::samples`] says which comes next, which is 1 where the picture had to start anew.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn refine(&mut self, inputs: &FrameInputs<'_>, index: u32) -> Result<Timings> {
        let lights = self.move_lights(inputs.time)?;
        let mut watch = Stopwatch::start(&self.pass_names);
        let mut fits = self.add_sample(inputs, index, &mut watch)?;
        while !fits {
            watch = Stopwatch::start(&self.pass_names);
            fits = self.add_sample(inputs, 0, &mut watch)?;
        }
        Ok(watch.stop().after(lights))
    }

    /// Moves the lights that move, unless they are there already; what that took.
    fn move_lights(&self, time: f64) -> Result<Option<Timings>> {
        if !self.scene.moves() {
            return Ok(None);
        }
        let watch = Stopwatch::start(&[]);
        self.scene.move_lights(time)?;
        Ok(Some(watch.stop()))
    }

    /// Adds up the samples; `None` if clusters or lists did not fit, and now have room.
    fn accumulate(&mut self, inputs: &FrameInputs<'_>) -> Result<Option<Timings>> {
        let mut watch = Stopwatch::start(&self.pass_names);
        for index in 0..inputs.samples {
            inputs.progress.inc(1);
            if !self.add_sample(inputs, index, &mut watch)? {
                inputs.progress.dec(u64::from(index) + 1);
                return Ok(None);
            }
        }
        Ok(Some(watch.stop()))
    }

    /// Adds one sample; `false` if clusters or lists did not fit, and now have room: then the picture starts anew.
    fn add_sample(&mut self, inputs: &FrameInputs<'_>, index: u32, watch: &mut Stopwatch) -> Result<bool> {
        self.update_constants(inputs, index)?;
        if index == 0 {
            self.forget_gathered();
        }
        let scales = self.scales(inputs, index + 1);
        let sample = Sample { first: index == 0, shaded: true, points: self.has_points(), scales };
        self.submit(sample, inputs.split, watch)?;
        watch.add_gpu(self.timestamps.intervals()?);
        self.samples = index + 1;
        self.counters = self.readback.read()?[0];
        if self.work.cut && self.counters.cut_given_up > 0 {
            self.give_up_cuts()?;
            return Ok(false);
        }
        if self.cluster.is_some()
            && let Some(capacity) = self.lists.capacity.grown(&self.counters)
        {
            self.grow(capacity)?;
            return Ok(false);
        }
        Ok(true)
    }

    fn submit(&self, sample: Sample, split: bool, watch: &mut Stopwatch) -> Result<()> {
        type Record<'a> = &'a dyn Fn(&Frame, &mut Commands);
        let resolve = |frame: &Self, cmd: &mut Commands| frame.record_resolve(cmd, sample);
        let forward = |frame: &Self, cmd: &mut Commands| frame.record_forward(cmd, sample);
        let steps: [(usize, Record<'_>); 4] = [
            (1, &Self::record_prepass),
            (usize::from(self.cluster.is_some()), &Self::record_cluster),
            (usize::from(self.resolve.is_some()), &resolve),
            (usize::MAX, &forward),
        ];
        if split {
            for (passes, record) in steps {
                let before = watch.cpu();
                self.device.run("pass", |cmd| {
                    record(self, cmd);
                    Ok(())
                })?;
                watch.add_cpu(passes, before);
            }
            return Ok(());
        }
        self.device.run("frame", |cmd| {
            steps.iter().for_each(|(_, record)| record(self, cmd));
            Ok(())
        })
    }

    fn record_prepass(&self, cmd: &mut Commands) {
        cmd.reset_timestamps(&self.timestamps);
        cmd.timestamp(&self.timestamps, 0);
        self.prepass.record(cmd, &self.view());
        cmd.timestamp(&self.timestamps, 1);
    }

    fn record_cluster(&self, cmd: &mut Commands) {
        let Some(cluster) = &self.cluster else { return };
        cmd.transition(&self.targets.cluster_ids, Use::FragmentRead, Use::ComputeWrite);
        cmd.transition(&self.lists.lists, Use::FragmentRead, Use::ComputeWrite);
        cluster.record(cmd, &self.view(), &self.lists, tiles_of(self.settings.size));
        cmd.transition(&self.targets.cluster_ids, Use::ComputeWrite, Use::FragmentRead);
        cmd.transition(&self.lists.lists, Use::ComputeWrite, Use::FragmentRead);
        cmd.memory_barrier(Use::ComputeWrite, Use::FragmentRead);
        cmd.timestamp(&self.timestamps, 2);
    }

    fn record_resolve(&self, cmd: &mut Commands, sample: Sample) {
        let Some(resolve) = &self.resolve else { return };
        let hdr = &self.targets.hdr;
        cmd.memory_barrier(Use::ComputeWrite, Use::ComputeRead);
        if sample.first {
            cmd.transition(hdr, Use::Nothing, Use::TransferWrite);
            cmd.clear(hdr);
            cmd.transition(hdr, Use::TransferWrite, Use::ComputeWrite);
        } else {
            cmd.transition(hdr, Use::TransferRead, Use::ComputeWrite);
        }
        if sample.points {
            resolve.record(cmd, &self.view());
        }
        cmd.timestamp(&self.timestamps, 3);
    }

    fn record_forward(&self, cmd: &mut Commands, sample: Sample) {
        let stamp = 2 + u32::from(self.cluster.is_some()) + u32::from(self.resolve.is_some());
        self.forward.record(cmd, &self.view(), sample, (&self.timestamps, stamp));
        if let Some(cluster) = self.cluster.as_ref().filter(|_| self.work.cut) {
            cmd.transition(&self.targets.hdr, Use::TransferRead, Use::ComputeRead);
            cluster.record_given_up(cmd, &self.view(), tiles_of(self.settings.size));
            cmd.transition(&self.targets.hdr, Use::ComputeRead, Use::TransferRead);
        }
        cmd.memory_barrier(Use::ComputeWrite, Use::TransferRead);
        cmd.copy_buffer(&self.lists.counters, &self.readback);
        cmd.memory_barrier(Use::TransferWrite, Use::HostRead);
    }

    fn view(&self) -> View<'_> {
        View { scene: &self.scene, draws: &self.draws, luminaires: &self.luminaires, frame: self.set.get(0) }
    }

    fn bind(&self) {
        let set = self.set.get(0);
        set.buffer(shared::frame::FRAME_CONSTANTS, &self.constants);
        set.image(shared::frame::FRAME_DEPTH, &self.targets.depth, Use::DepthRead);
        set.image(shared::frame::FRAME_CLUSTER_IDS_OUT, &self.targets.cluster_ids, Use::ComputeWrite);
        set.image(shared::frame::FRAME_CLUSTER_IDS, &self.targets.cluster_ids, Use::FragmentRead);
        set.image(shared::frame::FRAME_HDR, &self.targets.hdr, Use::InputRead);
        set.image(shared::frame::FRAME_SURFACE, &self.targets.surface, Use::ComputeRead);
        if self.work.cut {
            set.image(shared::frame::FRAME_HDR_READ, &self.targets.hdr, Use::ComputeRead);
        }
        if let Some(gather) = &self.gather {
            set.image(shared::frame::FRAME_GATHERED, gather.sums(), Use::FragmentRead);
        }
        self.lists.bind(set);
    }
}

fn pass_inputs<'a>(device: &'a Arc<Device>, scene: &'a GpuScene, settings: &FrameSettings) -> PassInputs<'a> {
    // A vector of lavapipe, or a warp.
    let lanes = settings.lanes.unwrap_or(if device.is_cpu() { 8 } else { 32 });
    PassInputs { device, scene, perspective: settings.perspective, lanes }
}

fn tiles_of(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(shared::TILE_SIZE))
}

fn tiles(size: [u32; 2]) -> u32 {
    let [x, y] = tiles_of(size);
    x * y
}
