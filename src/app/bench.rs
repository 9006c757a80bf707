//! `amas bench`: frame timing.

use super::args::{BenchOptions, SceneOptions};
use super::measure::Figure;
use super::outputs::{check_distinct, check_folder};
use super::report::{self, Clusters, Origin, Pairs, Pass};
use super::terminal::print;
use super::{FRAME_RATE, camera, in_scene, load_scene, warn_of_gathered_light};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings, Timings};
use crate::gpu::{Device, Options};
use crate::gpu_scene::GpuScene;
use crate::passes::floors::Floors;
use indicatif::ProgressBar;
use serde::Serialize;
use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::Arc;

/// Frames submitted pass by pass, for the passes' CPU time.
const SPLIT_FRAMES: u32 = 5;

#[derive(Serialize)]
struct Figures<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    points: Vec<Point>,
}

#[derive(Serialize)]
struct Point {
    scene: String,
    size: [u32; 2],
    frame_cpu_ms: Option<Figure>,
    frame_wall_ms: Option<Figure>,
    passes: Vec<Pass>,
    clusters: Clusters,
    pairs: Pairs,
    /// Nanoseconds a pair at least; `null` unless they were asked for and the scene has lights in lists.
    floors_ns: Option<Floors>,
}

pub(super) fn run(options: &BenchOptions) -> Result<()> {
    options.json.iter().try_for_each(|path| check_folder(path))?;
    options.scenes.iter().try_for_each(|scene| check_distinct(&options.json, Some(scene)))?;
    let device =
        Device::open(&Options { device: options.device.device.clone(), validate: options.device.validate })?;
    let scenes: Vec<Option<PathBuf>> = match options.scenes.as_slice() {
        [] => vec![None],
        scenes => scenes.iter().cloned().map(Some).collect(),
    };
    let points =
        scenes.into_iter().map(|scene| point(&device, options, scene)).collect::<Result<Vec<_>>>()?;
    if let Some(path) = &options.json {
        let figures = Figures { origin: Origin::of(device.info()), points };
        report::save(path, &figures)?;
    }
    device.require_silence()
}

fn point(device: &Arc<Device>, options: &BenchOptions, path: Option<PathBuf>) -> Result<Point> {
    let name = path.as_ref().map_or_else(|| "default".into(), |path| path.display().to_string());
    let scene_options = SceneOptions { scene: path, size: options.size, set: options.set.clone() };
    let scene = load_scene(&scene_options)?;
    let camera = camera(&scene, None)?;
    let gpu_scene = Arc::new(in_scene(&scene_options, GpuScene::new(device, &scene))?);
    warn_of_gathered_light(&scene);
    let settings = FrameSettings::new(&scene.render, camera);
    let mut frame = Frame::new(device, &gpu_scene, settings)?;
    let inputs = FrameInputs {
        camera,
        time: 0.0,
        samples: scene.render.samples,
        exposure: scene.render.exposure,
        split: false,
        progress: ProgressBar::hidden(),
    };
    let (whole, all) = measure(&mut frame, &inputs, options)?;
    report::warn_of_overflow(&frame.counters(), settings.max_lights_per_cluster);
    let [width, height] = settings.size;
    let passes = report::passes(&all);
    report::print_table(&format!("{name}, {width}x{height}, {}", device.info().name), &passes, &whole)?;
    let pairs = report::pairs(frame.pairs()?, &passes, device.info(), &scene.render);
    print(&pairs)?;
    let floors_ns = if options.floors { frame.floors()? } else { None };
    if let Some(floors) = &floors_ns {
        print(floors)?;
    }
    Ok(Point {
        scene: name,
        size: settings.size,
        frame_cpu_ms: report::figure(&whole, |t| Some(t.cpu_ms)),
        frame_wall_ms: report::figure(&whole, |t| Some(t.wall_ms)),
        clusters: report::clusters(&frame),
        pairs,
        passes,
        floors_ns,
    })
}

/// Timings of the whole frames, and of these and a few that are split by pass.
fn measure(
    frame: &mut Frame,
    inputs: &FrameInputs<'_>,
    options: &BenchOptions,
) -> Result<(Vec<Timings>, Vec<Timings>)> {
    let total = options.warmup + options.frames + SPLIT_FRAMES;
    let bar =
        if std::io::stderr().is_terminal() { ProgressBar::new(total.into()) } else { ProgressBar::hidden() };
    let mut index = 0;
    let mut render = |count: u32, split: bool| -> Result<Vec<Timings>> {
        (0..count)
            .map(|_| {
                bar.inc(1);
                index += 1;
                // Lights that move do so from frame to frame; the camera stands.
                let time = f64::from(index) / FRAME_RATE;
                frame.render(&FrameInputs { split, time, ..inputs.clone() })
            })
            .collect()
    };
    render(options.warmup, false)?;
    let whole = render(options.frames, false)?;
    let split = render(SPLIT_FRAMES, true)?;
    bar.finish_and_clear();
    Ok((whole.clone(), [whole, split].concat()))
}
