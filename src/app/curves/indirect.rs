//! The chapter on gathered light: how wrong it is after so many seconds, by the number of virtual lights and by rounds,
//! beside paths from the eye and virtual lights without a tree.

mod figures;
mod gathered;
mod page;
mod plain;
mod plot;
mod truth;

use super::super::load::{Load, Since};
use super::super::report::Origin;
use super::plot as plots;
use super::{progress, save_tables};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo};
use crate::scene::load_embedded;
use figures::{Point, points};
use gathered::Gatherer;
use plain::Plain;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use truth::Truth;

/// What is written.
pub(super) const FILES: [&str; 5] =
    ["indirect.csv", "indirect.json", "indirect.md", "indirect.svg", "indirect.png"];

/// A box with a red and a blue wall, lit by one panel: a glossy floor, a ball of gold, a matte block.
const ROOM: &str = include_str!("../../../scenes/indirect.toml");

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    size: [u32; 2],
    /// Virtual lights of a round.
    vpls: &'static [u32],
    /// Most rounds; errors are taken after each power of two.
    rounds: u32,
    /// Most paths of a pixel.
    paths: u32,
    /// Lights of those without a tree.
    plain: &'static [usize],
    repetitions: u32,
    /// Paths a pixel of the truth.
    truth: u32,
}

const FULL: Extent = Extent {
    size: [96, 72],
    vpls: &[256, 1024, 4096, 16384, 65536],
    rounds: 32,
    paths: 256,
    plain: &[16, 64, 256, 1024, 4096],
    repetitions: 3,
    truth: 8192,
};
const QUICK: Extent = Extent {
    size: [24, 24],
    vpls: &[1024, 16384],
    rounds: 8,
    paths: 64,
    plain: &[64, 256],
    repetitions: 1,
    truth: 1024,
};

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    extent: String,
    /// Standard error of the truth, relative to the picture's mean, root of the mean square over values.
    truth_error: f64,
    load: Option<Load>,
    quick: bool,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    extent: &'a str,
    truth_error: f64,
    load: Option<Load>,
    points: &'a [Point],
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let figures = measure(device, if quick { QUICK } else { FULL }, quick)?;
    device.require_silence()?;
    write(&FILES.map(|name| out.join(name)), device.info(), &figures)?;
    Ok(page::summary(&figures))
}

fn measure(device: &Arc<Device>, extent: Extent, quick: bool) -> Result<Figures> {
    let steps = extent.vpls.len() + 1 + extent.plain.len();
    let bar = progress(1 + steps * extent.repetitions as usize);
    bar.set_message("truth");
    let mut scene = load_embedded("indirect.toml", ROOM, &[], &[])?;
    scene.render.size = extent.size;
    let mut gatherer = Gatherer::new(device, &scene, extent.vpls)?;
    let truth = Truth::new(&scene, extent.truth, gatherer.direct_mean()?)?;
    bar.inc(1);
    let since = Since::now();
    let mut samples = Vec::new();
    for repetition in 0..extent.repetitions {
        for &vpls in extent.vpls {
            bar.set_message(format!("{vpls} virtual lights a round"));
            samples.extend(gatherer.refine(&truth, vpls, repetition, extent.rounds)?);
            bar.inc(1);
        }
        bar.set_message("paths");
        samples.extend(truth.paths(&scene, repetition, extent.paths)?);
        bar.inc(1);
        for &lights in extent.plain {
            bar.set_message(format!("{lights} lights without a tree"));
            samples.extend(Plain::new(&scene, gatherer.origin()).samples(&truth, lights, repetition));
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let [width, height] = extent.size;
    Ok(Figures {
        points: points(&samples, scene.render.vpls),
        extent: format!(
            "{width} × {height} pixels, {} bounces, {} repetitions with other seeds",
            scene.render.bounces, extent.repetitions
        ),
        truth_error: truth.relative_error(),
        load: since.load(),
        quick,
    })
}

/// Writes [`FILES`], each to its path.
fn write(paths: &[PathBuf; 5], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown, svg, png] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        extent: &figures.extent,
        truth_error: figures.truth_error,
        load: figures.load,
        points: &figures.points,
    };
    let rows = |file: &mut _| page::csv(file, &figures.points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))?;
    plots::save([svg, png], &plot::IndirectPlot(&figures.points))
}
