//! What is written: the figures of every point, and the measurements that they were made of.

use super::super::load::Load;
use super::super::measure::{Figure, MEGABYTE};
use super::super::report::{self, Clusters, Origin, Pairs, Pass};
use super::baseline::{Baseline, Comparison};
use super::subject::Subject;
use crate::frame::Timings;
use crate::passes::floors::Floors;
use serde::{Deserialize, Serialize};

/// Everything that `--json` writes.
#[derive(Serialize)]
pub(super) struct Figures<'a> {
    #[serde(flatten)]
    pub(super) origin: Origin<'a>,
    /// Interrupted, or not yet done.
    pub(super) partial: bool,
    /// Overrides that all scenes were given.
    pub(super) set: &'a [(String, String)],
    #[serde(rename = "load")]
    pub(super) loads: Loads,
    /// Largest resident set of the process, in which all points live.
    pub(super) peak_host_mb: Option<f64>,
    pub(super) baseline: Option<&'a Baseline>,
    pub(super) points: &'a [Point],
}

/// What else ran on the machine; `null` where the system does not tell.
#[derive(Clone, Copy, Deserialize, Serialize)]
pub(super) struct Loads {
    /// While the scenes were loaded and warmed up.
    pub(super) before: Option<Load>,
    /// While it was measured.
    pub(super) during: Option<Load>,
}

impl Loads {
    pub(super) fn any_busy(&self) -> bool {
        self.before.iter().chain(&self.during).any(Load::is_busy)
    }
}

#[derive(Serialize)]
pub(super) struct Point {
    pub(super) scene: String,
    pub(super) size: [u32; 2],
    frame_cpu_ms: Option<Figure>,
    frame_wall_ms: Option<Figure>,
    /// Between the timestamps of a frame.
    frame_gpu_ms: Option<Figure>,
    pub(super) passes: Vec<Pass>,
    clusters: Clusters,
    /// `null` for a start.
    pub(super) pairs: Option<Pairs>,
    /// Nanoseconds a pair at least; `null` unless they were asked for and the scene has lights in lists.
    pub(super) floors_ns: Option<Floors>,
    peak_memory: PeakMemory,
    pub(super) samples: Samples,
    /// With the baseline; `null` without.
    pub(super) comparison: Option<Comparison>,
}

#[derive(Serialize)]
struct PeakMemory {
    device_mb: f64,
}

/// Every measurement of a point's frames, milliseconds, in the order in which they were taken.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct Samples {
    pub(super) cpu_ms: Vec<f64>,
    pub(super) wall_ms: Vec<f64>,
    /// Empty on a device without timestamps, and for a start.
    pub(super) gpu_ms: Vec<f64>,
}

impl Samples {
    fn of(timings: &[Timings]) -> Self {
        let gpu = |frame: &Timings| {
            let passes: Vec<f64> = frame.passes.iter().filter_map(|pass| pass.gpu_ms).collect();
            (!passes.is_empty()).then(|| passes.iter().sum())
        };
        Self {
            cpu_ms: timings.iter().map(|frame| frame.cpu_ms).collect(),
            wall_ms: timings.iter().map(|frame| frame.wall_ms).collect(),
            gpu_ms: timings.iter().filter_map(gpu).collect(),
        }
    }
}

impl Point {
    pub(super) fn new(subject: &Subject) -> Self {
        let stage = subject.stage();
        let (passes, samples) = (subject.passes(), Samples::of(&subject.whole));
        let info = stage.device.info();
        Self {
            scene: subject.name(),
            size: stage.render.size,
            frame_cpu_ms: Figure::of(&samples.cpu_ms),
            frame_wall_ms: Figure::of(&samples.wall_ms),
            frame_gpu_ms: Figure::of(&samples.gpu_ms),
            clusters: report::clusters(&stage.frame),
            pairs: subject.pairs.map(|pairs| report::pairs(pairs, &passes, info, &stage.render)),
            passes,
            floors_ns: subject.floors,
            peak_memory: PeakMemory { device_mb: stage.device.peak_memory() as f64 / MEGABYTE },
            samples,
            comparison: None,
        }
    }
}
