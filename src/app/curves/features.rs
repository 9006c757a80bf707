//! The chapter on the cost of features: a frame of a scene that has them but does not use them, and of one that does, over
//! one of the same scene without; in turn, round after round.

mod page;
mod rows;

use super::super::default_scene;
use super::super::load::{Load, Since};
use super::super::measure::Figure;
use super::super::report::Origin;
use super::super::statistics::Ratio;
use super::subject::Subject;
use super::{progress, save_tables};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo};
use crate::passes::aov::Quantity;
use crate::scene::load_embedded;
use rows::{FEATURES, Feature, Variant};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is written.
pub(super) const FILES: [&str; 3] = ["features.csv", "features.json", "features.md"];

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    size: [u32; 2],
    rounds: usize,
    /// Every so many-th feature.
    step: usize,
}

const FULL: Extent = Extent { size: [160, 90], rounds: 60, step: 1 };
const QUICK: Extent = Extent { size: [48, 27], rounds: 6, step: 4 };

/// A feature and what it costs.
#[derive(Serialize)]
struct Point {
    feature: &'static str,
    /// How it is there without being used; `null` where it cannot be.
    unused: Option<&'static str>,
    used: Option<&'static str>,
    /// Milliseconds of a frame without it.
    base_ms: Figure,
    /// Over that.
    unused_ratio: Option<Ratio>,
    used_ratio: Option<Ratio>,
}

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    extent: Extent,
    load: Option<Load>,
    quick: bool,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    size: [u32; 2],
    rounds: usize,
    load: Option<Load>,
    points: &'a [Point],
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let figures = measure(device, if quick { QUICK } else { FULL }, quick)?;
    device.require_silence()?;
    write(&FILES.map(|name| out.join(name)), device.info(), &figures)?;
    Ok(page::summary(&figures.points))
}

/// The frame of a variant, warmed up.
fn subject(device: &Arc<Device>, variant: &Variant, size: [u32; 2]) -> Result<Subject> {
    let mut scene = load_embedded("feature", &variant.toml(), default_scene::FILES, &[])?;
    scene.render.size = size;
    let subject = Subject::new(device, scene)?;
    if variant.aov {
        subject.frame.aov(Quantity::Normal)?;
    }
    Ok(subject)
}

fn measure(device: &Arc<Device>, extent: Extent, quick: bool) -> Result<Figures> {
    let features: Vec<&Feature> = FEATURES.iter().step_by(extent.step).collect();
    let bar = progress(features.len());
    let since = Since::now();
    let mut points = Vec::new();
    for feature in features {
        bar.set_message(feature.name);
        points.push(point(device, feature, extent)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Figures { points, extent, load: since.load(), quick })
}

fn point(device: &Arc<Device>, feature: &Feature, extent: Extent) -> Result<Point> {
    let variants = [Some(&feature.base), feature.unused.as_ref(), feature.used.as_ref()];
    let mut subjects = Vec::new();
    for variant in variants {
        subjects.push(variant.map(|variant| subject(device, variant, extent.size)).transpose()?);
    }
    for round in 0..extent.rounds {
        // Whoever comes after another finds the caches in its state: all take turns at each place.
        for place in 0..subjects.len() {
            let index = (place + round) % subjects.len();
            subjects[index].iter_mut().try_for_each(Subject::measure)?;
        }
    }
    let times = |index: usize| {
        subjects[index].as_ref().map_or_else(Vec::new, |subject: &Subject| subject.times(device))
    };
    let base = times(0);
    let ratio = |index: usize| Ratio::of(&times(index), &base);
    Ok(Point {
        feature: feature.name,
        unused: feature.unused.as_ref().map(|variant| variant.what),
        used: feature.used.as_ref().map(|variant| variant.what),
        base_ms: Figure::of(&base).unwrap_or_default(),
        unused_ratio: ratio(1),
        used_ratio: ratio(2),
    })
}

/// Writes [`FILES`], each to its path.
fn write(paths: &[PathBuf; 3], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        size: figures.extent.size,
        rounds: figures.extent.rounds,
        load: figures.load,
        points: &figures.points,
    };
    let rows = |file: &mut _| page::csv(file, &figures.points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))
}
