//! The chapter on scaling: what a frame takes over the number of triangles, pixels, area lights and point lights; and
//! beside it what other programs take for the same scene.

mod grid;
mod page;
mod peers;
mod plot;
mod sweeps;

use super::super::load::{Load, Since};
use super::super::measure::Figure;
use super::super::report::{self, Origin};
use super::plot as plots;
use super::subject::{Subject, device_ms};
use super::{progress, save_tables, slope};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo};
use indicatif::ProgressBar;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use sweeps::{SWEEPS, Sweep};

/// What is written.
pub(super) const FILES: [&str; 5] =
    ["scaling.csv", "scaling.json", "scaling.md", "scaling.svg", "scaling.png"];

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    rounds: usize,
    /// Pictures have so many times fewer pixels across and down, but where these are counted.
    smaller: u32,
    /// At most so many settings of each sweep, the first of them.
    settings: usize,
}

const FULL: Extent = Extent { rounds: 9, smaller: 1, settings: usize::MAX };
const QUICK: Extent = Extent { rounds: 2, smaller: 8, settings: 2 };

/// A setting of a sweep, measured.
#[derive(Serialize)]
struct Point {
    sweep: &'static str,
    /// What there is of that which is counted.
    count: u64,
    size: [u32; 2],
    cpu_ms: Figure,
    wall_ms: Figure,
    /// Device time; `null` where the device does not tell.
    device_ms: Option<Figure>,
    /// CPU time on a CPU device, else device time if there is any: what is fitted.
    frame_ms: Figure,
    /// Pairs of pixel and point light, and of pixel and area light, that were evaluated, per pixel.
    pairs_per_pixel: f64,
}

/// How frame time grows with what is counted, at the end of a sweep: where that is little, other things cost more.
#[derive(Clone, Copy, Serialize)]
struct Growth {
    sweep: &'static str,
    /// Of the straight line through the logarithms of the last [`FITTED`] points, by least squares: 1 is proportional, 0
    /// constant.
    slope: f64,
    /// Nanoseconds that one more takes, between the last two points.
    ns_each: f64,
}

/// Points at the end of a sweep through which a line is laid.
const FITTED: usize = 3;

/// Count and milliseconds of these points, all or fewer.
fn fitted<'a>(points: &[&'a Point]) -> impl Iterator<Item = (f64, f64)> + Clone + use<'a> {
    let last: Vec<&Point> = points[points.len().saturating_sub(FITTED)..].to_vec();
    last.into_iter().map(|p| (p.count as f64, p.frame_ms.median))
}

impl Growth {
    /// `None` of fewer than two points, or of such with the same count.
    fn of(sweep: &'static str, points: &[&Point]) -> Option<Self> {
        let [.., before, last] = points else { return None };
        let more_ms = last.frame_ms.median - before.frame_ms.median;
        let ns_each = 1e6 * more_ms / (last.count as f64 - before.count as f64);
        let growth = Self { sweep, slope: slope(fitted(points)), ns_each };
        (growth.slope.is_finite() && ns_each.is_finite()).then_some(growth)
    }
}

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    growth: Vec<Growth>,
    rounds: usize,
    load: Option<Load>,
    quick: bool,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    rounds: usize,
    load: Option<Load>,
    points: &'a [Point],
    growth: &'a [Growth],
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let figures = measure(device, if quick { QUICK } else { FULL }, quick)?;
    device.require_silence()?;
    write(&FILES.map(|name| out.join(name)), device.info(), &figures)?;
    Ok(page::summary(&figures))
}

fn measure(device: &Arc<Device>, extent: Extent, quick: bool) -> Result<Figures> {
    let settings = |sweep: &Sweep| sweep.settings.len().min(extent.settings);
    let bar = progress(SWEEPS.iter().map(settings).sum::<usize>() * (1 + extent.rounds));
    let since = Since::now();
    let (mut points, mut growth) = (Vec::new(), Vec::new());
    for sweep in SWEEPS {
        bar.set_message(sweep.name);
        let own = of_sweep(device, sweep, extent, &bar)?;
        growth.extend(Growth::of(sweep.name, &own.iter().filter(|p| p.count > 0).collect::<Vec<_>>()));
        points.extend(own);
    }
    bar.finish_and_clear();
    Ok(Figures { points, growth, rounds: extent.rounds, load: since.load(), quick })
}

fn of_sweep(device: &Arc<Device>, sweep: &Sweep, extent: Extent, bar: &ProgressBar) -> Result<Vec<Point>> {
    let mut subjects = Vec::new();
    for &setting in sweep.settings.iter().take(extent.settings) {
        subjects.push(Subject::new(device, sweep.scene(setting, extent.smaller)?)?);
        bar.inc(1);
    }
    for _ in 0..extent.rounds {
        for subject in &mut subjects {
            subject.measure()?;
            bar.inc(1);
        }
    }
    subjects.iter().map(|subject| point(device, sweep, subject)).collect()
}

fn point(device: &Device, sweep: &Sweep, subject: &Subject) -> Result<Point> {
    let pairs = subject.frame.pairs()?;
    let size @ [width, height] = subject.scene.render.size;
    let timings = &subject.timings;
    Ok(Point {
        sweep: sweep.name,
        count: (sweep.count)(&subject.scene),
        size,
        cpu_ms: report::figure(timings, |t| Some(t.cpu_ms)).unwrap_or_default(),
        wall_ms: report::figure(timings, |t| Some(t.wall_ms)).unwrap_or_default(),
        device_ms: report::figure(timings, device_ms),
        frame_ms: Figure::of(&subject.times(device)).unwrap_or_default(),
        pairs_per_pixel: pairs.evaluated as f64 / f64::from(width * height),
    })
}

/// Writes [`FILES`], each to its path.
fn write(paths: &[PathBuf; 5], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown, svg, png] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        rounds: figures.rounds,
        load: figures.load,
        points: &figures.points,
        growth: &figures.growth,
    };
    let rows = |file: &mut _| page::csv(file, &figures.points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))?;
    plots::save([svg, png], &plot::ScalingPlot(figures))
}
