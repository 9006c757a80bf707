//! Options of the subcommands that make pictures, show them or compare them.

use super::{DeviceOptions, SceneOptions, parse_aov, parse_count, parse_whole, remedy};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct RenderOptions {
    #[command(flatten)]
    pub(in crate::app) scene: SceneOptions,
    #[command(flatten)]
    pub(in crate::app) device: DeviceOptions,
    /// Picture file, several times: .png (8-bit sRGB), .exr or .pfm (scene-linear) [default: amas.png]
    #[arg(short, long, value_name = "FILE")]
    pub(in crate::app) output: Vec<PathBuf>,
    /// Camera by name [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(in crate::app) camera: Option<String>,
    /// Frames A up to, not including, B, 30 a second: the camera on its path, lights that move on theirs; %04d in FILE is the
    /// frame's number in four digits, %d in as many as it has
    #[arg(long, value_name = "A..B", value_parser = parse_range, allow_hyphen_values = true)]
    pub(in crate::app) frames: Option<std::ops::Range<u32>>,
    /// Report as JSON; its pairs.area_saved counts what the clusters' masks spared of area lights
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::app) report: Option<PathBuf>,
    /// Output variable, several times: numbers in .exr or .pfm, colours in .png; the names are listed below
    #[arg(long, value_name = "NAME=FILE", value_parser = parse_aov)]
    pub(in crate::app) aov: Vec<(String, String)>,
    #[command(flatten)]
    pub(in crate::app) refine: RefineOptions,
}

/// Default of `--indirect-error`.
pub(in crate::app) const INDIRECT_ERROR: f64 = 0.02;

#[derive(Clone, Debug, ClapArgs)]
pub(in crate::app) struct RefineOptions {
    /// Refine indirect light and the shadows of point lights until the picture's estimated error, relative to its mean, is
    /// below E [default: 0.02]
    #[arg(long, value_name = "E", value_parser = parse_share, allow_negative_numbers = true)]
    pub(in crate::app) indirect_error: Option<f64>,
    /// Or until S seconds of gathering have passed, for each picture; they begin when its other light is there
    #[arg(long, value_name = "S", value_parser = parse_seconds, allow_negative_numbers = true)]
    pub(in crate::app) time_limit: Option<f64>,
}

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct ViewOptions {
    #[command(flatten)]
    pub(in crate::app) scene: SceneOptions,
    #[command(flatten)]
    pub(in crate::app) device: DeviceOptions,
    /// Camera to start from, by name [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(in crate::app) camera: Option<String>,
    /// Close after N pictures, a sample each, rendered one after the other
    #[arg(long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub(in crate::app) frames: Option<u32>,
    /// Use high dynamic range where the display offers it: scRGB or HDR10, white at 203 cd/m²
    #[arg(long)]
    pub(in crate::app) hdr: bool,
    /// A picture (.exr or .pfm) to compare with, instead of the reference
    #[arg(long, value_name = "FILE")]
    pub(in crate::app) compare: Option<PathBuf>,
    /// Sources of the shaders, compiled again when they change [default: those of the checkout that amas was built from]
    #[arg(long, value_name = "DIR")]
    pub(in crate::app) glsl: Option<PathBuf>,
    /// Print how long it took until window and picture were there
    #[arg(long)]
    pub(in crate::app) startup: bool,
    /// Do not wait for the display's refresh
    #[arg(long)]
    pub(in crate::app) no_vsync: bool,
}

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct ReferenceOptions {
    #[command(flatten)]
    pub(in crate::app) scene: SceneOptions,
    /// Picture file: .exr or .pfm
    #[arg(short, long, value_name = "FILE")]
    pub(in crate::app) output: PathBuf,
    /// Rays a pixel [default: the scene's samples]; 1 goes through its centre
    #[arg(long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub(in crate::app) spp: Option<u32>,
    /// Which light
    #[arg(long, value_enum, default_value = "direct")]
    pub(in crate::app) integrator: IntegratorName,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole::<u64>, allow_negative_numbers = true)]
    pub(in crate::app) seed: u64,
    /// Camera by name [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(in crate::app) camera: Option<String>,
    /// Frame of `amas render --frames`, 30 a second: the camera on its path, lights that move on theirs
    #[arg(long, value_name = "N", value_parser = parse_whole::<u32>, allow_negative_numbers = true)]
    pub(in crate::app) frame: Option<u32>,
    /// Relative standard error at which a pixel's area lights are done
    #[arg(long, value_name = "E", default_value_t = 1e-3, value_parser = parse_tolerance, allow_negative_numbers = true)]
    pub(in crate::app) tolerance: f64,
    /// Paths of each ray, for --integrator path [default: 64]
    #[arg(long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub(in crate::app) paths: Option<u32>,
    /// Most bounces between the surface seen and the light, for --integrator path; 0 is direct light [default: any]
    #[arg(long, value_name = "N", value_parser = parse_whole::<u32>, allow_negative_numbers = true)]
    pub(in crate::app) bounces: Option<u32>,
    /// Standard error of every value, as a picture
    #[arg(long, value_name = "FILE.exr")]
    pub(in crate::app) error: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(in crate::app) enum IntegratorName {
    /// Unshadowed direct light
    Direct,
    /// Direct light with visibility
    Shadowed,
    /// Full light transport, the background's too
    Path,
}

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct CompareOptions {
    /// Picture
    pub(in crate::app) a: PathBuf,
    /// Reference
    pub(in crate::app) b: PathBuf,
    /// Compare only where this picture is white
    #[arg(long, value_name = "M.png")]
    pub(in crate::app) mask: Option<PathBuf>,
    /// Compare means of N × N pixels; FLIP is that of whole pixels, whatever N is
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = parse_count, allow_negative_numbers = true)]
    pub(in crate::app) block: u32,
    /// Print JSON
    #[arg(long)]
    pub(in crate::app) json: bool,
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

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let tolerance = text.parse().ok().filter(|tolerance| (1e-9..=1.0).contains(tolerance));
    tolerance.ok_or_else(|| remedy("this is none", "give a number from 1e-9 to 1, such as 1e-4"))
}

fn parse_range(text: &str) -> Result<std::ops::Range<u32>, String> {
    let ends = text.split_once("..").and_then(|(a, b)| Some(a.parse().ok()?..b.parse().ok()?));
    ends.filter(|range| !range.is_empty())
        .ok_or_else(|| remedy("these are no frames", "write them as A..B with A < B, such as 0..60"))
}
