//! Options of the subcommands that make tables and figures.

use super::{DeviceOptions, parse_count, parse_set, parse_size, parse_whole};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct FitOptions {
    /// File of all layers' tables, as the program embeds it
    #[arg(long, value_name = "FILE")]
    pub(in crate::app) out: Option<PathBuf>,
    /// What a fit minimises
    #[arg(long, value_enum, default_value = "l1")]
    pub(in crate::app) objective: ObjectiveName,
    /// Folder for error maps (.png) and figures (.csv) of every layer; it is made in a folder that exists
    #[arg(long, value_name = "DIR")]
    pub(in crate::app) maps: Option<PathBuf>,
    /// Fit only this layer, several times
    #[arg(long, value_name = "NAME")]
    pub(in crate::app) layer: Vec<String>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(in crate::app) enum ObjectiveName {
    /// Total variation: the least error under any light
    L1,
    /// Mean square: keeps the peak's place and height better
    L2,
}

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct BenchOptions {
    /// Scene files [default: the embedded scene, where no suite is named]
    pub(in crate::app) scenes: Vec<PathBuf>,
    /// Points that are part of the program, several times
    #[arg(long, value_name = "NAME", value_enum)]
    pub(in crate::app) suite: Vec<Suite>,
    /// Picture size in pixels [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(in crate::app) size: Option<[u32; 2]>,
    /// Override a key of [render], such as render.front_end=fragment or compute
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_set)]
    pub(in crate::app) set: Vec<(String, String)>,
    #[command(flatten)]
    pub(in crate::app) device: DeviceOptions,
    /// Rounds: frames measured of each scene
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = parse_count, allow_negative_numbers = true)]
    pub(in crate::app) frames: u32,
    /// Frames of each rendered first and not measured
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = parse_whole::<u32>, allow_negative_numbers = true)]
    pub(in crate::app) warmup: u32,
    /// Also measure what a pair of pixel and light costs at least: its arithmetic alone, its fetches alone
    #[arg(long)]
    pub(in crate::app) floors: bool,
    /// Figures as JSON, every measurement among them
    #[arg(long, value_name = "FILE")]
    pub(in crate::app) json: Option<PathBuf>,
    /// Figures of an earlier run, as --json wrote them, to compare with
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::app) baseline: Option<PathBuf>,
}

/// Points of `amas bench` that are part of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::app) enum Suite {
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
pub(in crate::app) enum Chapter {
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
    /// Frame time by triangles, pixels, area lights and point lights, beside other programs
    Scaling,
    /// Shadows of area lights and edges by samples a pixel
    Samples,
    /// What is stored and how: tables, halves; and what is not there
    Choices,
}

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct ReportOptions {
    /// Folder for the files; it is made in a folder that exists
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub(in crate::app) out: PathBuf,
    /// One chapter only
    #[arg(long, value_name = "NAME")]
    pub(in crate::app) chapter: Option<Chapter>,
    /// Few configurations and repetitions: to see that it works
    #[arg(long)]
    pub(in crate::app) quick: bool,
    #[command(flatten)]
    pub(in crate::app) device: DeviceOptions,
}

#[derive(Debug, ClapArgs)]
pub(in crate::app) struct InfoOptions {
    /// Print JSON
    #[arg(long)]
    pub(in crate::app) json: bool,
}
