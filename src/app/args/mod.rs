//! The command line.

mod figures;
mod pictures;

use super::keys;
use crate::gpu::Options;
use clap::{Args as ClapArgs, Parser, Subcommand};
use std::path::PathBuf;
use std::str::FromStr;

pub(super) use figures::{
    BenchOptions, Chapter, FitOptions, InfoOptions, ObjectiveName, ReportOptions, Suite,
};
pub(super) use pictures::{
    CompareOptions, INDIRECT_ERROR, IntegratorName, ReferenceOptions, RefineOptions, RenderOptions,
    ViewOptions,
};

/// A clustered-forward renderer for very many lights, with every picture's error known.
///
/// Without a subcommand, renders the embedded default scene to amas.png.
#[derive(Debug, Parser)]
#[command(
    name = "amas",
    version,
    after_help = "Example:\n  amas render scene.toml -o picture.png -o picture.exr"
)]
pub(in crate::app) struct Args {
    #[command(subcommand)]
    pub(in crate::app) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(in crate::app) enum Command {
    /// Render a scene file to pictures, offscreen
    #[command(after_help = "Examples:
  amas render
  amas render scene.toml -o picture.png -o picture.exr --report report.json
  amas render scene.toml --frames 0..60 -o frame_%04d.png
  amas render scene.toml --set samples=16 --aov normal=normal.exr -o picture.png

Output variables of what is seen through the pixel's centre, 0 where nothing is, in red, green and blue:
  position     metres; no .png
  normal       unit, turned to the viewer
  depth        distance along the view, metres
  material     its number, from 0; -1 a light, -2 nothing
  albedo       what the diffuse part reflects; of metal, what it reflects at normal incidence
  roughness    alpha: its mean, along tangent, along bitangent; 1 without a specular lobe
  light_count  lights evaluated
  cluster      its number, from 0; -1 a light, or nothing
  slice        of the depth, from 0; -1 a light, or nothing
  pair_ratio   lights of the list over those within range (1 if none is), then both numbers
  folded       lights beyond the cap of the list, then those of the list
  light_error  estimated relative error of the cluster's many lights: all, of folds, of nodes
  ltc_bound    what area lights' closed form may be off by, a share of the specular lobe
  wireframe    pixels to the nearest edge of a triangle
  direct       light of the scene's own lights, without the background; no .png
  indirect     light that comes by way of other surfaces; no .png

Of the table that is printed, device ms is how long the device took, CPU ms the time of all threads of the process: of each
pass with --report, which has it wait for the one before. The last row has the time that passed, and CPU ms, for the whole
frame.")]
    Render(RenderOptions),
    /// Show a scene in a window and fly through it
    #[command(after_help = keys::help())]
    View(ViewOptions),
    /// Compute a picture in double precision on the CPU
    #[command(after_help = "Examples:
  amas reference scene.toml -o reference.exr --spp 4 --error error.exr
  amas reference scene.toml -o reference.exr --integrator path --paths 256")]
    Reference(ReferenceOptions),
    /// Error figures of picture A against picture B, the reference
    #[command(after_help = "Example:\n  amas compare picture.exr reference.exr --mask mask.png --json")]
    Compare(CompareOptions),
    /// Fit the tables of linearly transformed cosines for area lights, and print the residuals
    #[command(after_help = "Examples:
  amas fit --out src/ltc/tables.bin --maps docs/ltc
  amas fit --layer metal --objective l2")]
    Fit(FitOptions),
    /// Time frames pass by pass, and starts, and compare them with an earlier run
    #[command(after_help = "Examples:
  amas bench scenes/light_grid.toml --size 640x360 --frames 20 --json bench.json
  amas bench --suite lights --suite area --json before.json
  amas bench --suite lights --suite area --baseline before.json

A frame of each point is rendered in turn, round after round, so that whatever drifts on the machine is the same for all. Ctrl-C
ends after the frame at hand: what was measured is printed and written, as partial. Figures are written after every round.

A baseline is compared point by point where scene and size are the same: a point is faster or slower where that is so by more
than 2 % with 95 % confidence, else it is undecided, as it always is where either side has fewer than six rounds. CPU devices
are judged by CPU time, others by device time. Compare runs of the same command on an idle machine.")]
    Bench(BenchOptions),
    /// Measure speed against error, and write tables and plots
    #[command(after_help = "Examples:
  amas report --out docs
  amas report --chapter indirect --quick

Writes .csv, .json, .md, .svg and .png of each chapter. Times mean something on an idle machine only.")]
    Report(ReportOptions),
    /// List devices, and what each lacks
    #[command(after_help = "Example:\n  amas info --json")]
    Info(InfoOptions),
}

impl Default for Command {
    fn default() -> Self {
        Self::Render(RenderOptions {
            scene: SceneOptions { scene: None, size: None, set: Vec::new() },
            device: DeviceOptions {
                device: std::env::var("AMAS_DEVICE").ok(),
                validate: false,
                ray_queries: None,
            },
            output: Vec::new(),
            camera: None,
            frames: None,
            report: None,
            aov: Vec::new(),
            refine: RefineOptions { indirect_error: None, time_limit: None },
        })
    }
}

#[derive(Clone, Debug, ClapArgs)]
pub(in crate::app) struct DeviceOptions {
    /// Device by index or part of its name
    #[arg(long, value_name = "NAME|INDEX", env = "AMAS_DEVICE")]
    pub(in crate::app) device: Option<String>,
    /// Turn on the validation layers with synchronisation checks, and fail on a message
    #[arg(long)]
    pub(in crate::app) validate: bool,
    /// Whether rays are traced by ray queries where the device has them: true or false [default: true unless it is a CPU]
    #[arg(long, value_name = "BOOL", env = "AMAS_RAY_QUERIES", hide_env = true)]
    pub(in crate::app) ray_queries: Option<bool>,
}

impl DeviceOptions {
    /// As the device's opening takes them.
    pub(in crate::app) fn asked(&self) -> Options {
        let Self { device, validate, ray_queries } = self.clone();
        Options { device, validate, ray_queries }
    }
}

#[derive(Clone, Debug, ClapArgs)]
pub(in crate::app) struct SceneOptions {
    /// Scene file [default: the embedded scene]
    pub(in crate::app) scene: Option<PathBuf>,
    /// Picture size in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(in crate::app) size: Option<[u32; 2]>,
    /// Override a key of [render], such as render.samples=16; render.front_end=fragment, compute or auto (compute on
    /// software devices, fragments on others) says what shades the lights in lists
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_set)]
    pub(in crate::app) set: Vec<(String, String)>,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides.ok_or_else(|| remedy("this is no size", "write it as WIDTHxHEIGHT, such as 640x360"))
}

/// What is wrong with an option's value, in the form of our other errors.
fn remedy(cause: &str, remedy: &str) -> String {
    format!("{cause}\n  remedy: {remedy}")
}

fn parse_count(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| *count > 0);
    count.ok_or_else(|| remedy("this is no number above 0", "give a whole number from 1 to 4294967295"))
}

fn parse_whole<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| remedy("this is no whole number from 0 on", "give a number such as 0 or 12"))
}

fn parse_set(text: &str) -> Result<(String, String), String> {
    parse_pair(text)
        .ok_or_else(|| remedy("this is no KEY=VALUE", "name a key and its value, such as samples=16"))
}

fn parse_aov(text: &str) -> Result<(String, String), String> {
    let pair = parse_pair(text);
    pair.ok_or_else(|| {
        remedy("this is no NAME=FILE", "name a variable and its file, such as normal=normal.exr")
    })
}

fn parse_pair(text: &str) -> Option<(String, String)> {
    let (key, value) = text.split_once('=')?;
    (!key.is_empty() && !value.is_empty()).then(|| (key.into(), value.into()))
}
