//! The chapter on area lights: what a light costs a pixel, and how wrong it is, by each way to estimate it.

mod configurations;
mod figures;
mod page;
mod plot;
mod sizes;
mod tiers;

use super::super::report::Origin;
use super::plot as plots;
use super::{progress, save_tables};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo};
use crate::gpu_scene::GpuScene;
use crate::scene::{Model, Scene};
use crate::shared::{MAX_AREA_LIGHTS, TIER_LIGHTS};
use configurations::{
    BANDS, Configuration, DISTRIBUTION, Lights, MODELS, SHAPES, SHARES, configurations, material,
};
use figures::{FLOOR, Point, complete, front};
use indicatif::ProgressBar;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tiers::{Bench, Family, Pipelines, TIERS};

/// What is written.
pub(super) const FILES: [&str; 7] =
    ["area.csv", "area.json", "area.md", "area.svg", "area.png", "sizes.svg", "sizes.png"];

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    configurations: usize,
    repetitions: usize,
    models: usize,
    shapes: usize,
    /// Of [`SHARES`].
    shares: &'static [f64],
    /// Standard error of the oracle, relative.
    tolerance: f64,
}

const FULL: Extent =
    Extent { configurations: 64, repetitions: 5, models: 2, shapes: 3, shares: &SHARES, tolerance: 2e-4 };
const QUICK: Extent = Extent {
    configurations: 12,
    repetitions: 1,
    models: 1,
    shapes: 1,
    shares: &[SHARES[0], SHARES[3]],
    tolerance: 1e-3,
};

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    /// By the light's size.
    sizes: Vec<Point>,
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
    /// The same by the light's size.
    sizes: &'a [Point],
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
    // Cells of squares that a scene has room for.
    let at_once = MAX_AREA_LIGHTS as usize / (extent.configurations * TIER_LIGHTS as usize);
    let kinds = models.len() * shapes.len();
    let scenes = kinds + (BANDS.len() * extent.shares.len()).div_ceil(at_once);
    let cells = BANDS.len() * (kinds + extent.shares.len());
    let bar = progress(TIERS.len() * (scenes + cells * extent.repetitions));
    let mut points = Vec::new();
    for &model in models {
        for &shape in shapes {
            let any = |(band, alphas)| Cell { band, alphas, model, shape, share: None };
            points.extend(of_cells(device, &BANDS.map(any), extent, &bar)?);
        }
    }
    let model = MODELS[MODELS.len() - 1];
    let swept = |share: f64| {
        BANDS.map(|(band, alphas)| Cell { band, alphas, model, shape: "square", share: Some(share) })
    };
    let swept: Vec<Cell> = extent.shares.iter().copied().flat_map(swept).collect();
    let mut sizes = Vec::new();
    for cells in swept.chunks(at_once) {
        sizes.extend(of_cells(device, cells, extent, &bar)?);
    }
    front(&mut sizes);
    bar.finish_and_clear();
    let extent = format!(
        "{} surfaces a cell with 8 lights each, {} repetitions, oracle to {:e}",
        extent.configurations, extent.repetitions, extent.tolerance
    );
    Ok(Figures { points: complete(points, BANDS.map(|(band, _)| band)), sizes, extent, quick })
}

/// Surfaces and lights that are measured together.
#[derive(Clone, Copy)]
struct Cell {
    band: &'static str,
    alphas: &'static [f64],
    model: (&'static str, Model),
    shape: &'static str,
    /// Of the hemisphere's solid angle; `None`: any size.
    share: Option<f64>,
}

impl Cell {
    fn configurations(&self, extent: Extent) -> Vec<Configuration> {
        let lights = self.share.map_or(Lights::Any(self.shape), Lights::Squares);
        configurations(self.model.1, lights, self.alphas, extent.configurations, extent.tolerance)
    }
}

/// All tiers on cells of one model and one kind of light.
fn of_cells(device: &Arc<Device>, cells: &[Cell], extent: Extent, bar: &ProgressBar) -> Result<Vec<Point>> {
    let Some(&Cell { model: (name, model), shape, .. }) = cells.first() else { return Ok(Vec::new()) };
    bar.set_message(format!("{name}, {shape}"));
    let filled: Vec<_> = cells.iter().map(|cell| cell.configurations(extent)).collect();
    let lights = filled.iter().flatten().flat_map(|one| &one.lights).cloned().collect();
    let scene = Scene { area_lights: lights, materials: vec![material(model)], ..Scene::default() };
    let scene = GpuScene::new(device, &scene)?;
    let pipelines = Pipelines::new(device, model, &scene.area.specialization, || bar.inc(1))?;
    let (mut first, mut points) = (0, Vec::new());
    for (cell, filled) in cells.iter().zip(&filled) {
        let bench = Bench::new(device, &scene, &pipelines, filled, first)?;
        first += filled.iter().map(|one| one.lights.len()).sum::<usize>();
        let times = times(&bench, extent.repetitions, bar)?;
        for (index, tier) in TIERS.iter().enumerate().filter(|(_, tier)| tier.family != Family::None) {
            let values = bench.values(index)?;
            let names = [cell.band, name, shape];
            points.push(Point::new(names, cell.share, tier, &times[index], filled, &values));
        }
    }
    Ok(points)
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
fn write(paths: &[PathBuf; 7], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown, svg, png, sizes_svg, sizes_png] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        distribution: DISTRIBUTION,
        extent: &figures.extent,
        floor: FLOOR,
        points: &figures.points,
        sizes: &figures.sizes,
    };
    let rows = |file: &mut _| page::csv(file, figures.points.iter().chain(&figures.sizes));
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))?;
    plots::save([svg, png], &plot::AreaPlot(&figures.points))?;
    plots::save([sizes_svg, sizes_png], &sizes::SizesPlot(&figures.sizes))
}
