//! The chapter on area lights: what a light costs a pixel, and how wrong it is, by each way to estimate it.

mod configurations;
mod figures;
mod page;
mod plot;
mod tiers;

use super::super::report::Origin;
use super::plot as plots;
use super::{progress, save_tables};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo};
use crate::gpu_scene::GpuScene;
use crate::scene::Scene;
use configurations::{BANDS, DISTRIBUTION, MODELS, SHAPES, configurations, material};
use figures::{FLOOR, Point, complete};
use indicatif::ProgressBar;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tiers::{Bench, Family, Pipelines, TIERS};

/// What is written.
pub(super) const FILES: [&str; 5] = ["area.csv", "area.json", "area.md", "area.svg", "area.png"];

/// How much is measured.
struct Extent {
    configurations: usize,
    repetitions: usize,
    models: usize,
    shapes: usize,
    /// Standard error of the oracle, relative.
    tolerance: f64,
}

const FULL: Extent = Extent { configurations: 64, repetitions: 9, models: 2, shapes: 3, tolerance: 2e-4 };
const QUICK: Extent = Extent { configurations: 12, repetitions: 1, models: 1, shapes: 1, tolerance: 1e-3 };

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    extent: String,
    quick: bool,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    distribution: &'static str,
    extent: &'a str,
    /// Errors are relative to the truth, or to this share of the mean truth of the cell.
    floor: f64,
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
    let models = &MODELS[MODELS.len() - extent.models..];
    let shapes = &SHAPES[..extent.shapes];
    let bar = progress(models.len() * shapes.len() * TIERS.len() * (1 + BANDS.len() * extent.repetitions));
    let mut points = Vec::new();
    for &(name, model) in models {
        for &shape in shapes {
            bar.set_message(format!("{name}, {shape}"));
            let cells = BANDS.map(|(_, alphas)| {
                configurations(model, shape, alphas, extent.configurations, extent.tolerance)
            });
            let lights = cells.iter().flatten().flat_map(|one| &one.lights).cloned().collect();
            let scene = Scene { area_lights: lights, materials: vec![material(model)], ..Scene::default() };
            let scene = GpuScene::new(device, &scene)?;
            let pipelines = Pipelines::new(device, model, &scene.area.specialization, || bar.inc(1))?;
            let mut first = 0;
            for ((band, _), cell) in BANDS.into_iter().zip(&cells) {
                let bench = Bench::new(device, &scene, &pipelines, cell, first)?;
                first += cell.iter().map(|one| one.lights.len()).sum::<usize>();
                let times = times(&bench, extent.repetitions, &bar)?;
                for (index, tier) in TIERS.iter().enumerate().filter(|(_, tier)| tier.family != Family::None)
                {
                    let values = bench.values(index)?;
                    points.push(Point::new([band, name, shape], tier, &times[index], cell, &values));
                }
            }
        }
    }
    bar.finish_and_clear();
    let extent = format!(
        "{} surfaces a cell with 8 lights each, {} repetitions, oracle to {:e}",
        extent.configurations, extent.repetitions, extent.tolerance
    );
    Ok(Figures { points: complete(points, BANDS.map(|(band, _)| band)), extent, quick })
}

/// Nanoseconds of every tier in turn, again and again, less those of the one that does nothing.
fn times(bench: &Bench<'_>, repetitions: usize, bar: &ProgressBar) -> Result<Vec<Vec<f64>>> {
    let mut times = vec![Vec::new(); TIERS.len()];
    // The first run of a pipeline may still compile.
    (0..TIERS.len()).try_for_each(|tier| bench.time(tier).map(|_| ()))?;
    for _ in 0..repetitions {
        let nothing = bench.time(0)?;
        for (index, times) in times.iter_mut().enumerate() {
            times.push((bench.time(index)? - nothing).max(0.1));
            bar.inc(1);
        }
    }
    Ok(times)
}

/// Writes [`FILES`], each to its path.
fn write(paths: &[PathBuf; 5], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown, svg, png] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        distribution: DISTRIBUTION,
        extent: &figures.extent,
        floor: FLOOR,
        points: &figures.points,
    };
    let rows = |file: &mut _| page::csv(file, &figures.points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))?;
    plots::save([svg, png], &plot::AreaPlot(&figures.points))
}
