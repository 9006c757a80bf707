//! The chapter on what was chosen without a knob: how many texels and bits the tables of transformed cosines have, halves
//! for textures, and clusters that are not split by normals. Nothing here is timed.

mod cones;
mod halves;
mod page;
mod plot;
mod tables;

use super::super::report::Origin;
use super::plot as plots;
use super::{progress, save_tables};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo};
use cones::Behind;
use halves::Rounding;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tables::Stored;

/// What is written.
pub(super) const FILES: [&str; 5] =
    ["choices.csv", "choices.json", "choices.md", "choices.svg", "choices.png"];

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    /// Places in a table.
    places: usize,
    /// Pixels of the pictures whose pairs are counted.
    size: [u32; 2],
}

const FULL: Extent = Extent { places: 192, size: [160, 90] };
const QUICK: Extent = Extent { places: 8, size: [32, 18] };

/// Everything that was measured.
#[derive(Serialize)]
struct Figures {
    tables: Vec<Stored>,
    halves: Vec<Rounding>,
    cones: Vec<Behind>,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    places: usize,
    #[serde(flatten)]
    figures: &'a Figures,
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let extent = if quick { QUICK } else { FULL };
    let bar = progress(3);
    let done = |_: &_| bar.inc(1);
    let figures = Figures {
        tables: tables::measure(extent.places).inspect(|all| done(&all.len()))?,
        halves: halves::measure().inspect(|all| done(&all.len()))?,
        cones: cones::measure(extent.size).inspect(|all| done(&all.len()))?,
    };
    bar.finish_and_clear();
    write(&FILES.map(|name| out.join(name)), device.info(), &figures, (quick, extent))?;
    Ok(page::summary(&figures))
}

/// Writes [`FILES`], each to its path.
fn write(
    paths: &[PathBuf; 5],
    device: &DeviceInfo,
    figures: &Figures,
    (quick, extent): (bool, Extent),
) -> Result<()> {
    let [csv, json, markdown, svg, png] = paths;
    let content = File { origin: Origin::of(device), quick, places: extent.places, figures };
    let rows = |file: &mut _| page::csv(file, figures);
    save_tables([csv, json, markdown], rows, &content, &page::page(figures, quick, extent))?;
    plots::save([svg, png], &plot::ChoicesPlot(&figures.tables))
}
