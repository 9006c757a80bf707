//! The command line.

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::str::FromStr;

/// A clustered-forward renderer for very many lights, with every picture's error known.
///
/// Without a subcommand, renders the embedded default scene to amas.png.
#[derive(Debug, Parser)]
#[command(
    name = "amas",
    version,
    after_help = "Example:\n  amas render scene.toml -o picture.png -o picture.exr"
)]
pub(super) struct Args {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
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
    #[command(after_help = "Keys, letters by their place on the keyboard:
  W A S D     forward, left, backward, right
  Q E         down, up
  drag        look around
  right drag  turn around the point where the drag began; also Ctrl + drag
  wheel       fly faster or slower; two fingers on a touchpad do, too
  pinch       nearer to and farther from what is looked at
  1 … 9       the scene's cameras, in the file's order
  P           walk along the camera's path, or stop
  R           reset the camera
  C           print the camera as TOML, and copy it to the clipboard
  V           wait for the display's refresh, or not
  F5          load the scene again, as also happens when one of its files changes
  O           panels: times, counts, view, settings, what is picked
  I           inspect what is under the pointer
  F2 F3 F4    debug views: albedo, normal, roughness; again: the picture
  F6 F7 F8    depth, depth slice, cluster
  F9 F10 F11  lights evaluated, lights evaluated per useful one, estimated error
  B           bound of the error of area lights' closed form
  G           wireframe: the edges of triangles
  X           beside the reference, the error against it, the picture alone
  ?           these keys; also F1
  L           scenes shown before; a number loads one
  F12         save the picture to amas_0001.png and .exr, or the next free number
  Esc         stop loading; else close
A scene or an OBJ file that is dropped on the window is shown there.

Example:
  amas view scene.toml --size 1280x720 --camera main")]
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
            device: DeviceOptions { device: std::env::var("AMAS_DEVICE").ok(), validate: false },
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
pub(super) struct DeviceOptions {
    /// Device by index or part of its name
    #[arg(long, value_name = "NAME|INDEX", env = "AMAS_DEVICE")]
    pub(super) device: Option<String>,
    /// Turn on the validation layers with synchronisation checks, and fail on a message
    #[arg(long)]
    pub(super) validate: bool,
}

#[derive(Clone, Debug, ClapArgs)]
pub(super) struct SceneOptions {
    /// Scene file [default: the embedded scene]
    pub(super) scene: Option<PathBuf>,
    /// Picture size in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(super) size: Option<[u32; 2]>,
    /// Override a key of [render], such as render.samples=16; render.front_end=fragment, compute or auto (compute on
    /// software devices, fragments on others) says what shades the lights in lists
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_set)]
    pub(super) set: Vec<(String, String)>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct RenderOptions {
    #[command(flatten)]
    pub(super) scene: SceneOptions,
    #[command(flatten)]
    pub(super) device: DeviceOptions,
    /// Picture file, several times: .png (8-bit sRGB), .exr or .pfm (scene-linear) [default: amas.png]
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Camera by name [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(super) camera: Option<String>,
    /// Frames A up to, not including, B, 30 a second: the camera on its path, lights that move on theirs; %04d in FILE is the
    /// frame's number in four digits, %d in as many as it has
    #[arg(long, value_name = "A..B", value_parser = parse_range, allow_hyphen_values = true)]
    pub(super) frames: Option<std::ops::Range<u32>>,
    /// Report as JSON; its pairs.area_saved counts what the clusters' masks spared of area lights
    #[arg(long, value_name = "FILE.json")]
    pub(super) report: Option<PathBuf>,
    /// Output variable, several times: numbers in .exr or .pfm, colours in .png; the names are listed below
    #[arg(long, value_name = "NAME=FILE", value_parser = parse_aov)]
    pub(super) aov: Vec<(String, String)>,
    #[command(flatten)]
    pub(super) refine: RefineOptions,
}

/// Default of `--indirect-error`.
pub(super) const INDIRECT_ERROR: f64 = 0.02;

#[derive(Clone, Debug, ClapArgs)]
pub(super) struct RefineOptions {
    /// Refine indirect light and the shadows of point lights until the picture's estimated error, relative to its mean, is
    /// below E [default: 0.02]
    #[arg(long, value_name = "E", value_parser = parse_share, allow_negative_numbers = true)]
    pub(super) indirect_error: Option<f64>,
    /// Or until S seconds of gathering have passed, for each picture; they begin when its other light is there
    #[arg(long, value_name = "S", value_parser = parse_seconds, allow_negative_numbers = true)]
    pub(super) time_limit: Option<f64>,
}

fn parse_share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if share > 0.0 && share < f64::INFINITY => Ok(share),
        _ => Err(remedy("this is no share above 0", "give a number above 0, such as 0.02")),
    }
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.0..1e9).contains(&seconds) => Ok(seconds),
        _ => Err(remedy("this is no time from 0 to 1e9 s", "give seconds, such as 30")),
    }
}

#[derive(Debug, ClapArgs)]
pub(super) struct ViewOptions {
    #[command(flatten)]
    pub(super) scene: SceneOptions,
    #[command(flatten)]
    pub(super) device: DeviceOptions,
    /// Camera to start from, by name [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(super) camera: Option<String>,
    /// Close after N pictures, a sample each, rendered one after the other
    #[arg(long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub(super) frames: Option<u32>,
    /// Use high dynamic range where the display offers it: scRGB or HDR10, white at 203 cd/m²
    #[arg(long)]
    pub(super) hdr: bool,
    /// A picture (.exr or .pfm) to compare with, instead of the reference
    #[arg(long, value_name = "FILE")]
    pub(super) compare: Option<PathBuf>,
    /// Sources of the shaders, compiled again when they change [default: those of the checkout that amas was built from]
    #[arg(long, value_name = "DIR")]
    pub(super) glsl: Option<PathBuf>,
    /// Print how long it took until window and picture were there
    #[arg(long)]
    pub(super) startup: bool,
    /// Do not wait for the display's refresh
    #[arg(long)]
    pub(super) no_vsync: bool,
}

#[derive(Debug, ClapArgs)]
pub(super) struct ReferenceOptions {
    #[command(flatten)]
    pub(super) scene: SceneOptions,
    /// Picture file: .exr or .pfm
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: PathBuf,
    /// Rays a pixel [default: the scene's samples]; 1 goes through its centre
    #[arg(long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub(super) spp: Option<u32>,
    /// Which light
    #[arg(long, value_enum, default_value = "direct")]
    pub(super) integrator: IntegratorName,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole::<u64>, allow_negative_numbers = true)]
    pub(super) seed: u64,
    /// Camera by name [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(super) camera: Option<String>,
    /// Frame of `amas render --frames`, 30 a second: the camera on its path, lights that move on theirs
    #[arg(long, value_name = "N", value_parser = parse_whole::<u32>, allow_negative_numbers = true)]
    pub(super) frame: Option<u32>,
    /// Relative standard error at which a pixel's area lights are done
    #[arg(long, value_name = "E", default_value_t = 1e-3, value_parser = parse_tolerance, allow_negative_numbers = true)]
    pub(super) tolerance: f64,
    /// Paths of each ray, for --integrator path [default: 64]
    #[arg(long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub(super) paths: Option<u32>,
    /// Most bounces between the surface seen and the light, for --integrator path; 0 is direct light [default: any]
    #[arg(long, value_name = "N", value_parser = parse_whole::<u32>, allow_negative_numbers = true)]
    pub(super) bounces: Option<u32>,
    /// Standard error of every value, as a picture
    #[arg(long, value_name = "FILE.exr")]
    pub(super) error: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum IntegratorName {
    /// Unshadowed direct light
    Direct,
    /// Direct light with visibility
    Shadowed,
    /// Full light transport, the background's too
    Path,
}

#[derive(Debug, ClapArgs)]
pub(super) struct CompareOptions {
    /// Picture
    pub(super) a: PathBuf,
    /// Reference
    pub(super) b: PathBuf,
    /// Compare only where this picture is white
    #[arg(long, value_name = "M.png")]
    pub(super) mask: Option<PathBuf>,
    /// Compare means of N × N pixels; FLIP is that of whole pixels, whatever N is
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = parse_count, allow_negative_numbers = true)]
    pub(super) block: u32,
    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, ClapArgs)]
pub(super) struct FitOptions {
    /// File of all layers' tables, as the program embeds it
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    /// What a fit minimises
    #[arg(long, value_enum, default_value = "l1")]
    pub(super) objective: ObjectiveName,
    /// Folder for error maps (.png) and figures (.csv) of every layer; it is made in a folder that exists
    #[arg(long, value_name = "DIR")]
    pub(super) maps: Option<PathBuf>,
    /// Fit only this layer, several times
    #[arg(long, value_name = "NAME")]
    pub(super) layer: Vec<String>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum ObjectiveName {
    /// Total variation: the least error under any light
    L1,
    /// Mean square: keeps the peak's place and height better
    L2,
}

#[derive(Debug, ClapArgs)]
pub(super) struct BenchOptions {
    /// Scene files [default: the embedded scene, where no suite is named]
    pub(super) scenes: Vec<PathBuf>,
    /// Points that are part of the program, several times
    #[arg(long, value_name = "NAME", value_enum)]
    pub(super) suite: Vec<Suite>,
    /// Picture size in pixels [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(super) size: Option<[u32; 2]>,
    /// Override a key of [render], such as render.front_end=fragment or compute
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_set)]
    pub(super) set: Vec<(String, String)>,
    #[command(flatten)]
    pub(super) device: DeviceOptions,
    /// Rounds: frames measured of each scene
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = parse_count, allow_negative_numbers = true)]
    pub(super) frames: u32,
    /// Frames of each rendered first and not measured
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = parse_whole::<u32>, allow_negative_numbers = true)]
    pub(super) warmup: u32,
    /// Also measure what a pair of pixel and light costs at least: its arithmetic alone, its fetches alone
    #[arg(long)]
    pub(super) floors: bool,
    /// Figures as JSON, every measurement among them
    #[arg(long, value_name = "FILE")]
    pub(super) json: Option<PathBuf>,
    /// Figures of an earlier run, as --json wrote them, to compare with
    #[arg(long, value_name = "FILE.json")]
    pub(super) baseline: Option<PathBuf>,
}

/// Points of `amas bench` that are part of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Suite {
    /// Point lights: by their number, without a range, more than a list holds
    Lights,
    /// Area lights of every kind, many of them, a shadow
    Area,
    /// The five BSDFs
    Bsdf,
    /// Frames of gathered light: by the number of virtual lights, point lights with shadows
    Indirect,
    /// Each pass where it is the dearest
    Passes,
    /// From nothing to the first picture, with the driver's cache warm
    Startup,
    /// All of these
    All,
}

/// A chapter of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Chapter {
    /// Area lights
    Area,
    /// Point lights by the thousand
    Lights,
    /// Gathered light
    Indirect,
    /// Formulas that break in float32, as they are usually written and as they ship
    Hard,
    /// What each feature costs where it is used, and where it is not
    Features,
}

#[derive(Debug, ClapArgs)]
pub(super) struct ReportOptions {
    /// Folder for the files; it is made in a folder that exists
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub(super) out: PathBuf,
    /// One chapter only
    #[arg(long, value_name = "NAME")]
    pub(super) chapter: Option<Chapter>,
    /// Few configurations and repetitions: to see that it works
    #[arg(long)]
    pub(super) quick: bool,
    #[command(flatten)]
    pub(super) device: DeviceOptions,
}

#[derive(Debug, ClapArgs)]
pub(super) struct InfoOptions {
    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides.ok_or_else(|| remedy("this is no size", "write it as WIDTHxHEIGHT, such as 640x360"))
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let tolerance = text.parse().ok().filter(|tolerance| (1e-9..=1.0).contains(tolerance));
    tolerance.ok_or_else(|| remedy("this is none", "give a number from 1e-9 to 1, such as 1e-4"))
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

fn parse_range(text: &str) -> Result<std::ops::Range<u32>, String> {
    let ends = text.split_once("..").and_then(|(a, b)| Some(a.parse().ok()?..b.parse().ok()?));
    ends.filter(|range| !range.is_empty())
        .ok_or_else(|| remedy("these are no frames", "write them as A..B with A < B, such as 0..60"))
}
