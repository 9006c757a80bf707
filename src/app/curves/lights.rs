//! The chapter on point lights by the thousand: what a picture costs, and how wrong it is, by each knob.

mod device;
mod order;
mod page;
mod plot;
mod sweeps;

use super::super::load::{Load, Since};
use super::super::measure::Figure;
use super::super::report::{self, Origin};
use super::plot as plots;
use super::{progress, save_tables};
use crate::compare::{self, Options};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings, Timings};
use crate::gpu::{Device, DeviceInfo};
use crate::gpu_scene::GpuScene;
use crate::image::HdrImage;
use crate::scene::Scene;
use cpu_time::ProcessTime;
use device::Orders;
use glam::Vec3;
use indicatif::ProgressBar;
use order::{Order, nodes_visited};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use sweeps::{GROWTH, Lights, SWEEPS, Setting, Sweep, drawn};

/// What is written.
pub(super) const FILES: [&str; 5] = ["lights.csv", "lights.json", "lights.md", "lights.svg", "lights.png"];

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    size: [u32; 2],
    /// log2 of what the sweeps' lights are divided by.
    fewer: u32,
    /// Every so many-th position of a knob.
    step: usize,
    repetitions: usize,
}

const FULL: Extent = Extent { size: [320, 180], fewer: 0, step: 1, repetitions: 9 };
const QUICK: Extent = Extent { size: [64, 36], fewer: 4, step: 3, repetitions: 1 };

/// One setting of a knob.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Point {
    /// Which knob.
    sweep: &'static str,
    /// Where it stands.
    setting: f64,
    /// What that is called.
    label: String,
    /// Random sampling, which the knob is judged beside.
    sampled: bool,
    /// Point lights of the scene.
    lights: usize,
    /// CPU time of the process, milliseconds a frame.
    cpu_ms: Figure,
    /// Wall time.
    wall_ms: Figure,
    /// CPU time of the order of the lights and the tree over them, milliseconds: once where they stand.
    tree_ms: Figure,
    /// Nodes of the tree over lights with a range that a frame tests.
    nodes_visited: u64,
    /// Pairs of pixel and light a pixel.
    pairs_per_pixel: f64,
    /// Evaluated pairs over useful ones.
    pair_ratio: f64,
    /// Relative error against every light on every pixel: mean and 99th percentile.
    error: f64,
    error_p99: f64,
    /// Mean of the picture over that of the truth, less 1.
    bias: f64,
    /// Neither more nor less of the knob is both faster and more exact.
    pareto: bool,
    /// What ships.
    default: bool,
}

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    orders: Orders,
    extent: String,
    load: Option<Load>,
    quick: bool,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    extent: &'a str,
    load: Option<Load>,
    orders: &'a Orders,
    points: &'a [Point],
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let figures = measure(device, quick)?;
    device.require_silence()?;
    write(&FILES.map(|name| out.join(name)), device.info(), &figures)?;
    Ok(page::summary(&figures))
}

fn measure(device: &Arc<Device>, quick: bool) -> Result<Figures> {
    let extent = if quick { QUICK } else { FULL };
    let settings: usize =
        SWEEPS.iter().map(|sweep| sweep.settings.len().div_ceil(sweep.step(extent.step))).sum();
    let bar = progress(settings * (2 + extent.repetitions) + extent.repetitions);
    let since = Since::now();
    let mut points = Vec::new();
    let mut last = None;
    for sweep in SWEEPS {
        bar.set_message(sweep.name);
        points.extend(of_sweep(device, sweep, extent, &mut last, &bar)?);
    }
    bar.set_message("host and device");
    let most: Vec<Vec3> =
        last.iter().flat_map(|last| &last.scene.point_lights).map(|light| light.position).collect();
    let orders = Orders::measure(device, &most, extent.repetitions, &bar)?;
    bar.finish_and_clear();
    let extent =
        format!("{} × {} pixels, {} repetitions", extent.size[0], extent.size[1], extent.repetitions);
    Ok(Figures { points, orders, extent, load: since.load(), quick })
}

/// A setting's frame, and what it is compared with.
struct Subject {
    setting: Setting,
    scene: Scene,
    frame: Frame,
    truth: HdrImage,
    timings: Vec<Timings>,
    /// CPU milliseconds of order and tree.
    trees: Vec<f64>,
}

/// What was uploaded last, which of its lights, and its truth.
struct Uploaded {
    scene: Scene,
    lights: Lights,
    gpu_scene: Arc<GpuScene>,
    truth: HdrImage,
}

impl Uploaded {
    /// A scene with its lights, or some of them. Most knobs leave the lights alone. The truth is that of a setting before, of the
    /// same scene with all lights, or else rendered.
    fn new(device: &Arc<Device>, scene: &Scene, lights: Lights, last: Option<Self>) -> Result<Self> {
        let last = last.filter(|last| last.scene.point_lights == scene.point_lights);
        let (gpu_scene, truth) = match last {
            Some(last) if last.lights == lights => (last.gpu_scene, last.truth),
            last => {
                let gpu_scene = upload(device, scene, lights)?;
                let truth = match (last, lights) {
                    (Some(last), _) => last.truth,
                    (None, Lights::All(_)) => brute_force(device, &gpu_scene, scene)?,
                    (None, Lights::Random(_)) => {
                        brute_force(device, &upload(device, scene, Lights::All(Order::Hilbert))?, scene)?
                    }
                };
                (gpu_scene, truth)
            }
        };
        Ok(Self { scene: scene.clone(), lights, gpu_scene, truth })
    }
}

fn upload(device: &Arc<Device>, scene: &Scene, lights: Lights) -> Result<Arc<GpuScene>> {
    let gpu_scene = match lights {
        Lights::All(Order::Hilbert) => GpuScene::new(device, scene)?,
        Lights::All(order) => {
            let mut gpu_scene = GpuScene::new(device, scene)?;
            gpu_scene.take_lights(device, order.tree(&scene.point_lights, gpu_scene.origin))?;
            gpu_scene
        }
        Lights::Random(count) => {
            let point_lights = drawn(&scene.point_lights, count);
            GpuScene::new(device, &Scene { point_lights, ..scene.clone() })?
        }
    };
    Ok(Arc::new(gpu_scene))
}

/// Every light on every pixel.
fn brute_force(device: &Arc<Device>, gpu_scene: &Arc<GpuScene>, scene: &Scene) -> Result<HdrImage> {
    let settings = FrameSettings { brute_force: true, ..settings(scene) };
    let mut frame = Frame::new(device, gpu_scene, settings)?;
    render(&mut frame, scene)?;
    frame.hdr()
}

fn of_sweep(
    device: &Arc<Device>,
    sweep: &Sweep,
    extent: Extent,
    last: &mut Option<Uploaded>,
    bar: &ProgressBar,
) -> Result<Vec<Point>> {
    let mut subjects = Vec::new();
    for &setting in sweep.settings.iter().step_by(sweep.step(extent.step)) {
        let scene = sweep.scene(setting, extent.size, extent.fewer)?;
        let uploaded = Uploaded::new(device, &scene, setting.lights(), last.take())?;
        bar.inc(1);
        let settings = FrameSettings { clusters: setting.clusters(), ..settings(&scene) };
        let mut frame = Frame::new(device, &uploaded.gpu_scene, settings)?;
        // The first frame compiles, and makes room for its lists.
        render(&mut frame, &scene)?;
        bar.inc(1);
        let truth = uploaded.truth.clone();
        *last = Some(uploaded);
        subjects.push(Subject { setting, scene, frame, truth, timings: Vec::new(), trees: Vec::new() });
    }
    for _ in 0..extent.repetitions {
        for subject in &mut subjects {
            subject.timings.push(render(&mut subject.frame, &subject.scene)?);
            subject.trees.push(tree_ms(subject.setting.lights(), &subject.scene));
            bar.inc(1);
        }
    }
    let points = subjects.iter().map(|subject| point(sweep, subject)).collect::<Result<Vec<_>>>()?;
    let beaten = |p: &Point| {
        let faster = |q: &&Point| q.cpu_ms.median < p.cpu_ms.median;
        points.iter().filter(faster).any(|q| q.error <= p.error)
    };
    let front: Vec<bool> = points.iter().map(|p| !beaten(p)).collect();
    Ok(points.into_iter().zip(front).map(|(point, pareto)| Point { pareto, ..point }).collect())
}

fn settings(scene: &Scene) -> FrameSettings {
    FrameSettings::new(&scene.render, &scene.cameras[0])
}

fn render(frame: &mut Frame, scene: &Scene) -> Result<Timings> {
    frame.render(&FrameInputs {
        camera: &scene.cameras[0],
        time: 0.0,
        samples: 1,
        exposure: 0.0,
        split: false,
        progress: ProgressBar::hidden(),
    })
}

fn tree_ms(lights: Lights, scene: &Scene) -> f64 {
    let (order, sample) = match lights {
        Lights::All(order) => (order, None),
        Lights::Random(count) => (Order::Hilbert, Some(drawn(&scene.point_lights, count))),
    };
    let clock = ProcessTime::now();
    let tree = order.tree(sample.as_ref().unwrap_or(&scene.point_lights), Vec3::ZERO);
    let taken = clock.elapsed();
    drop(tree);
    taken.as_secs_f64() * 1e3
}

/// Frame time at most over that at least lights of the sweep of their number, without the tree.
fn growth(points: &[Point]) -> Option<f64> {
    let mut own = points.iter().filter(|p| p.sweep == GROWTH);
    let first = own.next()?;
    own.next_back().map(|last| last.cpu_ms.median / first.cpu_ms.median.max(f64::MIN_POSITIVE))
}

fn point(sweep: &Sweep, subject: &Subject) -> Result<Point> {
    let Subject { setting, scene, frame, truth, timings, trees } = subject;
    let options = Options { mask: None, block: 1, display_referred: false };
    let picture = frame.hdr()?;
    let figures = compare::compare(&picture, truth, &options)?;
    let sum = |image: &HdrImage| image.pixels.iter().flatten().map(|&v| f64::from(v)).sum::<f64>();
    let pairs = frame.pairs()?;
    let [width, height] = scene.render.size;
    Ok(Point {
        sweep: sweep.name,
        setting: setting.value(scene),
        label: setting.label(scene),
        sampled: matches!(setting, Setting::Random(_)),
        lights: scene.point_lights.len(),
        cpu_ms: report::figure(timings, |t| Some(t.cpu_ms)).unwrap_or_default(),
        wall_ms: report::figure(timings, |t| Some(t.wall_ms)).unwrap_or_default(),
        tree_ms: Figure::of(trees).unwrap_or_default(),
        nodes_visited: nodes_visited(frame)?,
        pairs_per_pixel: pairs.evaluated as f64 / f64::from(width * height),
        pair_ratio: pairs.evaluated as f64 / pairs.useful.max(1) as f64,
        error: figures.mean_relative_error,
        error_p99: figures.p99,
        bias: sum(&picture) / sum(truth).max(f64::MIN_POSITIVE) - 1.0,
        pareto: false,
        default: setting.is_default(),
    })
}

/// Writes [`FILES`], each to its path.
fn write(paths: &[PathBuf; 5], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown, svg, png] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        extent: &figures.extent,
        load: figures.load,
        orders: &figures.orders,
        points: &figures.points,
    };
    let rows = |file: &mut _| page::csv(file, &figures.points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))?;
    plots::save([svg, png], &plot::LightsPlot(&figures.points))
}
