//! The chapter on samples: error against time by samples a pixel, with and without shadows of area lights, beside random
//! paths in double precision.

mod page;
mod plot;
mod truth;

use super::super::load::{Load, Since};
use super::super::measure::Figure;
use super::super::report::{self, Origin};
use super::plot as plots;
use super::subject::Subject;
use super::{progress, save_tables, slope};
use crate::error::Result;
use crate::frame::Timings;
use crate::gpu::{Device, DeviceInfo};
use crate::image::HdrImage;
use crate::reference::{self, Integrator, Options};
use crate::scene::{Scene, load_embedded};
use indicatif::ProgressBar;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use truth::Truth;

/// What is written.
pub(super) const FILES: [&str; 5] =
    ["samples.csv", "samples.json", "samples.md", "samples.svg", "samples.png"];

/// A floor that fills the view, half of it in the penumbra of a sheet above the view: no edges and no highlights, whose pixels
/// would outweigh all others.
const SCENE: &str = r#"
[[camera]]
name = "main"
position = [0, 0.8, 0.8]
target = [0, 0, 0]
orthographic_height = 1
[[material]]
name = "floor"
type = "plastic"
diffuse = [0.3, 0.2, 0.1]
alpha = 0.3
[[material]]
name = "black"
type = "matte"
color = [0, 0, 0]
[[mesh]]
shape = "plane"
size = 20
material = "floor"
[[mesh]]
shape = "plane"
size = [0.6, 0.4]
translate = [0.1, 1.5, 0]
material = "black"
[[light]]
type = "rect"
center = [0.1, 3, 0]
u = [0.25, 0, 0]
v = [0, 0, 0.15]
radiance = [8, 7, 6]
visible = false
[[light]]
type = "disk"
center = [-0.8, 2.8, -1]
normal = [0.2, -1, 0.3]
radius = 0.3
radiance = [6, 6, 9]
visible = false
[[light]]
type = "line"
a = [-0.6, 2.4, -1.2]
b = [0.9, 2.6, -1.2]
radius = 0.04
radiance = [9, 9, 9]
visible = false
"#;

/// How much is measured.
#[derive(Clone, Copy)]
struct Extent {
    size: [u32; 2],
    samples: &'static [u32],
    rounds: usize,
    /// Camera rays of a pixel of the truth.
    rays: u32,
    /// Standard error of a pixel of the truth, relative.
    tolerance: f64,
}

const FULL: Extent = Extent {
    size: [36, 24],
    samples: &[1, 2, 4, 8, 16, 32, 64, 128, 256],
    rounds: 5,
    rays: 16,
    tolerance: 2e-3,
};
const QUICK: Extent =
    Extent { size: [18, 12], samples: &[1, 4, 16, 64], rounds: 1, rays: 4, tolerance: 5e-3 };

/// A way to render the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Family {
    /// With shadows: a ray a sample, light and lobe.
    Shadows,
    /// Without: samples have nothing to do, where there are no edges.
    Unshadowed,
    /// With shadows by the oracle's paths: a light and a direction of the BSDF at random for each ray.
    Paths,
}

const FAMILIES: [Family; 3] = [Family::Shadows, Family::Unshadowed, Family::Paths];

impl Family {
    fn name(self) -> &'static str {
        match self {
            Self::Shadows => "amas, shadows",
            Self::Unshadowed => "amas, no shadows",
            Self::Paths => "paths, shadows",
        }
    }
}

/// A picture by so many samples.
#[derive(Serialize)]
struct Point {
    family: Family,
    samples: u32,
    cpu_ms: Figure,
    wall_ms: Figure,
    /// Root mean square error over the mean, with the truth's own.
    error: f64,
    /// Mean over that of the truth, less 1.
    bias: f64,
    /// Nothing of the same picture is both faster and more exact.
    pareto: bool,
    /// What a scene gets that does not say.
    default: bool,
}

/// Exponent of the error over the samples.
#[derive(Clone, Copy, Serialize)]
struct Law {
    family: Family,
    exponent: f64,
}

/// Everything that was measured.
struct Figures {
    points: Vec<Point>,
    laws: Vec<Law>,
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
    /// Most of a pixel's standard error, relative.
    truth_error: f64,
    load: Option<Load>,
    points: &'a [Point],
    laws: &'a [Law],
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let figures = measure(device, if quick { QUICK } else { FULL }, quick)?;
    device.require_silence()?;
    write(&FILES.map(|name| out.join(name)), device.info(), &figures)?;
    Ok(page::summary(&figures))
}

fn scene(family: Family, samples: u32, size: [u32; 2]) -> Result<Scene> {
    let mut scene = load_embedded("samples.toml", SCENE, &[], &[])?;
    scene.render.size = size;
    scene.render.samples = samples;
    scene.render.shadows = family != Family::Unshadowed;
    Ok(scene)
}

fn measure(device: &Arc<Device>, extent: Extent, quick: bool) -> Result<Figures> {
    let bar = progress(2 + 3 * extent.samples.len());
    bar.set_message("truth");
    let truths = [Truth::new(Family::Shadows, extent)?, Truth::new(Family::Unshadowed, extent)?];
    bar.inc(2);
    let since = Since::now();
    let mut points = Vec::new();
    for family in FAMILIES {
        bar.set_message(family.name());
        let truth = &truths[usize::from(family == Family::Unshadowed)];
        points.extend(of_family(device, family, extent, truth, &bar)?);
    }
    bar.finish_and_clear();
    // Without shadows what is left is the lights' own error, whatever the samples.
    let random = [Family::Shadows, Family::Paths];
    let laws = random.map(|family| Law { family, exponent: slope(places(&points, family)) });
    let laws = laws.into_iter().filter(|law| law.exponent.is_finite()).collect();
    front(&mut points);
    Ok(Figures { points, laws, extent, load: since.load(), quick })
}

/// Samples and error of a family.
fn places(points: &[Point], family: Family) -> impl Iterator<Item = (f64, f64)> + Clone {
    points.iter().filter(move |p| p.family == family).map(|p| (f64::from(p.samples), p.error))
}

/// Marks what nothing of the same picture beats.
fn front(points: &mut [Point]) {
    let same = |p: &Point, q: &Point| (p.family == Family::Unshadowed) == (q.family == Family::Unshadowed);
    let beaten = |p: &Point| {
        points.iter().any(|q| same(p, q) && q.cpu_ms.median < p.cpu_ms.median && q.error <= p.error)
    };
    let front: Vec<bool> = points.iter().map(|p| !beaten(p)).collect();
    points.iter_mut().zip(front).for_each(|(point, pareto)| point.pareto = pareto);
}

fn of_family(
    device: &Arc<Device>,
    family: Family,
    extent: Extent,
    truth: &Truth,
    bar: &ProgressBar,
) -> Result<Vec<Point>> {
    let default = Scene::default().render.samples;
    let one = |&samples: &u32| {
        let scene = scene(family, samples, extent.size)?;
        let (timings, image) = match family {
            Family::Paths => paths(&scene, extent.rounds)?,
            _ => frames(device, scene, extent.rounds)?,
        };
        bar.inc(1);
        let [error, bias] = truth.judge(&image);
        Ok(Point {
            family,
            samples,
            cpu_ms: report::figure(&timings, |t| Some(t.cpu_ms)).unwrap_or_default(),
            wall_ms: report::figure(&timings, |t| Some(t.wall_ms)).unwrap_or_default(),
            error,
            bias,
            pareto: false,
            default: samples == default && family != Family::Paths,
        })
    };
    extent.samples.iter().map(one).collect()
}

fn frames(device: &Arc<Device>, scene: Scene, rounds: usize) -> Result<(Vec<Timings>, HdrImage)> {
    let mut subject = Subject::new(device, scene)?;
    (0..rounds).try_for_each(|_| subject.measure())?;
    let image = subject.frame.hdr()?;
    Ok((subject.timings, image))
}

/// One path for each camera ray.
fn paths(scene: &Scene, rounds: usize) -> Result<(Vec<Timings>, HdrImage)> {
    let options =
        Options { integrator: Integrator::Path, paths: 1, bounces: 0, seed: 1, ..Options::of_scene(scene) };
    let mut image = HdrImage::new(0, 0);
    let mut timings = Vec::new();
    for _ in 0..rounds {
        timings.push(Timings::of("paths", || {
            image = reference::render(scene, &scene.cameras[0], &options)?.image;
            Ok(())
        })?);
    }
    Ok((timings, image))
}

/// Writes [`FILES`], each to its path.
fn write(paths: &[PathBuf; 5], device: &DeviceInfo, figures: &Figures) -> Result<()> {
    let [csv, json, markdown, svg, png] = paths;
    let content = File {
        origin: Origin::of(device),
        quick: figures.quick,
        size: figures.extent.size,
        truth_error: figures.extent.tolerance,
        load: figures.load,
        points: &figures.points,
        laws: &figures.laws,
    };
    let rows = |file: &mut _| page::csv(file, &figures.points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, figures))?;
    plots::save([svg, png], &plot::SamplesPlot(&figures.points))
}
