//! The report and the pass table.

use super::measure::{Figure, MEGABYTE, peak_host_memory};
use super::terminal::{complain, percent, print};
use crate::error::Result;
use crate::frame::{Frame, Timings};
use crate::gpu::{Device, DeviceInfo};
use crate::image::write_atomically;
use crate::passes::pairs::PairCount;
use crate::scene::{RenderSettings, Scene};
use crate::shared::Counters;
use serde::Serialize;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

/// What every file of figures begins with.
#[derive(Serialize)]
pub(super) struct Origin<'a> {
    schema: u32,
    device: &'a DeviceInfo,
    /// Version of amas.
    version: &'static str,
    /// Commit it was built from; `null` outside a checkout.
    commit: Option<&'static str>,
}

impl<'a> Origin<'a> {
    pub(super) fn of(device: &'a DeviceInfo) -> Self {
        Self { schema: 1, device, version: env!("CARGO_PKG_VERSION"), commit: option_env!("AMAS_COMMIT") }
    }
}

/// Time of one pass.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pass {
    name: &'static str,
    /// `null` on a device without timestamps.
    gpu_ms: Option<Figure>,
    /// CPU time of the process; subpasses share theirs as they share device time.
    cpu_ms: Option<f64>,
    /// The same with its spread.
    cpu: Option<Figure>,
}

/// What the cluster pass counted.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Clusters {
    /// Tiles across, tiles down, depth slices.
    grid: [u32; 3],
    occupied: u32,
    list_entries: u32,
    longest_list: u32,
    overflowed: u32,
    /// Nodes and leaves of all cuts of the tree over lights without a range.
    cut_entries: u32,
    longest_cut: u32,
    /// Lights beyond the lists' cap, summed over clusters: nodes stand for them.
    folded_lights: u32,
    /// Largest estimate of the mean relative error that this causes in a cluster.
    max_folded_error: f32,
}

/// Pairs of pixel and light.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pairs {
    evaluated: u64,
    useful: u64,
    /// Area lights among those evaluated; luminaires count as surfaces.
    area_evaluated: u64,
    /// Pairs of pixel and area light that the clusters' masks left out.
    area_saved: u64,
    per_pixel: f64,
    /// Shading time over evaluated pairs: CPU time on a CPU device, else device time.
    ns_per_pair: Option<f64>,
}

#[derive(Serialize)]
struct SceneSize {
    triangles: usize,
    materials: usize,
    point_lights: usize,
    area_lights: usize,
}

#[derive(Serialize)]
struct ImageSize {
    width: u32,
    height: u32,
}

#[derive(Serialize)]
struct FrameTime {
    wall_ms: Option<Figure>,
    cpu_ms: Option<Figure>,
}

#[derive(Serialize)]
struct ErrorEstimate {
    /// Mean over the pixels with a surface, of what folding and cuts cause; 0 where every light that reaches a pixel is
    /// evaluated.
    light_relative: f64,
    /// Of gathered light, by the spread of its rounds; `null` before there are two.
    indirect_relative: Option<f64>,
}

#[derive(Serialize)]
struct PeakMemory {
    host_mb: Option<f64>,
    device_mb: f64,
}

/// Everything that `--report` writes.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    schema: u32,
    device: &'a DeviceInfo,
    scene: SceneSize,
    image: ImageSize,
    passes: Vec<Pass>,
    clusters: Clusters,
    frame: FrameTime,
    pairs: Pairs,
    error_estimate: ErrorEstimate,
    #[serde(skip_serializing_if = "Option::is_none")]
    validation_messages: Option<usize>,
    peak_memory: PeakMemory,
}

impl<'a> Report<'a> {
    /// The report of frames that took `timings`, and the largest error of gathered light; pairs are those of the last.
    pub(super) fn new(
        device: &'a Arc<Device>,
        scene: &Scene,
        frame: &Frame,
        (timings, gathered_error): (&[Timings], Option<f64>),
    ) -> Result<Self> {
        let passes = passes(timings, timings);
        let clusters = clusters(frame);
        let [width, height] = scene.render.size;
        Ok(Self {
            schema: 1,
            device: device.info(),
            scene: SceneSize {
                triangles: scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum(),
                materials: scene.materials.len(),
                point_lights: scene.point_lights.len(),
                area_lights: scene.area_lights.len(),
            },
            image: ImageSize { width, height },
            pairs: pairs(frame.pairs()?, &passes, device.info(), &scene.render),
            passes,
            frame: FrameTime {
                wall_ms: figure(timings, |t| Some(t.wall_ms)),
                cpu_ms: figure(timings, |t| Some(t.cpu_ms)),
            },
            error_estimate: ErrorEstimate {
                light_relative: frame.light_error()?,
                indirect_relative: gathered_error,
            },
            clusters,
            validation_messages: device.validation_messages().map(|messages| messages.len()),
            peak_memory: PeakMemory {
                host_mb: peak_host_memory().map(|bytes| bytes as f64 / MEGABYTE),
                device_mb: device.peak_memory() as f64 / MEGABYTE,
            },
        })
    }
}

/// Passes in frame order: device time over several frames, CPU time over those that were split by pass.
pub(super) fn passes(timings: &[Timings], split: &[Timings]) -> Vec<Pass> {
    let passes = timings.first().map_or(&[][..], |timings| &timings.passes);
    let pass = |(i, name): (usize, &'static str)| {
        let cpu = figure(split, |t| t.passes.get(i)?.cpu_ms);
        let gpu_ms = figure(timings, |t| t.passes.get(i)?.gpu_ms);
        Pass { name, gpu_ms, cpu_ms: cpu.map(|figure| figure.median), cpu }
    };
    passes.iter().map(|pass| pass.name).enumerate().map(pass).collect()
}

/// A figure over frames.
pub(super) fn figure(timings: &[Timings], value: impl Fn(&Timings) -> Option<f64>) -> Option<Figure> {
    Figure::of(&timings.iter().filter_map(value).collect::<Vec<_>>())
}

/// What the last frame's cluster pass counted.
pub(super) fn clusters(frame: &Frame) -> Clusters {
    let Counters {
        occupied, entries, longest, overflowed, folded, fold_error, cut_entries, cut_longest, ..
    } = frame.counters();
    Clusters {
        grid: frame.grid(),
        occupied,
        list_entries: entries,
        longest_list: longest,
        overflowed,
        cut_entries,
        longest_cut: cut_longest,
        folded_lights: folded,
        max_folded_error: f32::from_bits(fold_error),
    }
}

/// Pairs, and what one cost.
pub(super) fn pairs(
    count: PairCount,
    passes: &[Pass],
    device: &DeviceInfo,
    render: &RenderSettings,
) -> Pairs {
    let [width, height] = render.size;
    let time = |pass: &Pass| {
        if device.kind == "cpu" { pass.cpu_ms } else { pass.gpu_ms.map(|ms| ms.median) }
    };
    let shading = passes.iter().filter(|pass| matches!(pass.name, "resolve" | "direct" | "indirect"));
    let ms: Option<f64> = shading.map(time).sum();
    // Passes are timed over all samples, pairs counted in the last.
    let ms = ms.map(|ms| ms / f64::from(render.samples));
    Pairs {
        evaluated: count.evaluated,
        useful: count.useful,
        area_evaluated: count.area,
        area_saved: count.area_all - count.area,
        per_pixel: count.evaluated as f64 / (f64::from(width) * f64::from(height)),
        ns_per_pair: ms.filter(|_| count.evaluated > 0).map(|ms| ms * 1e6 / count.evaluated as f64),
    }
}

impl std::fmt::Display for Pairs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ratio = self.evaluated as f64 / self.useful.max(1) as f64;
        write!(f, "{:.1} pairs a pixel, {ratio:.2} evaluated per useful one", self.per_pixel)?;
        let area = self.area_evaluated + self.area_saved;
        if self.area_saved > 0 {
            write!(f, ", {} of {area} with area lights saved by clusters", self.area_saved)?;
        }
        self.ns_per_pair.map_or(Ok(()), |ns| write!(f, ", {ns:.2} ns a pair"))
    }
}

/// Writes JSON, all or nothing.
pub(super) fn save(path: &Path, value: &impl Serialize) -> Result<()> {
    write_atomically(path, |file| {
        serde_json::to_writer_pretty(&mut *file, value).map_err(std::io::Error::other)?;
        file.write_all(b"\n")
    })
}

/// Prints the table of `render` and `bench`.
pub(super) fn print_table(title: &str, passes: &[Pass], frames: &[Timings]) -> Result<()> {
    let ms = |figure: Option<Figure>| match figure {
        Some(figure) if figure.n > 1 => format!("{:9.2} ± {:.2}", figure.median, figure.mad),
        Some(figure) => format!("{:9.2}", figure.median),
        None => format!("{:>9}", "-"),
    };
    print(title)?;
    // A frame in one piece, faster than one whose passes wait for each other, has no CPU time of each.
    let split = passes.iter().any(|pass| pass.cpu_ms.is_some());
    print(format_args!("{:<10} {:>9}       {:>9}", "pass", "device ms", "CPU ms"))?;
    for pass in passes {
        let none = || if split { format!("{:>9}", "-") } else { String::new() };
        let cpu = pass.cpu_ms.map_or_else(none, |ms| format!("{ms:9.2}"));
        print(format_args!("{:<10} {:<16}{cpu}", pass.name, ms(pass.gpu_ms)))?;
    }
    let [wall, cpu] = [figure(frames, |t| Some(t.wall_ms)), figure(frames, |t| Some(t.cpu_ms))].map(ms);
    print(format_args!(
        "{:<10} {wall} ms passed, {} ms of CPU time in all threads",
        "frame",
        cpu.trim_start()
    ))
}

/// Says what full lists cost the picture.
pub(super) fn warn_of_overflow(counters: &Counters, cap: u32) {
    if counters.overflowed > 0 {
        let error = percent(f32::from_bits(counters.fold_error).into());
        complain(format_args!(
            "warning: {} of {} clusters are reached by more than {cap} lights (at most {}); {} list entries were folded, \
             which changes a cluster by about {error} at most\n  remedy: raise render.max_lights_per_cluster (up to 2048), \
             or shorten the lights' ranges",
            counters.overflowed, counters.occupied, counters.longest, counters.folded
        ));
    }
}
