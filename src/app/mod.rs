//! The subcommands: the only module that knows the command line, the environment and file names.

mod aovs;
mod args;
mod bench;
mod compare;
mod curves;
mod default_scene;
mod false_color;
mod fit;
mod fit_maps;
mod info;
mod interrupt;
mod keys;
mod load;
mod measure;
mod outputs;
mod reference;
mod refine;
mod render;
mod report;
mod statistics;
mod terminal;
#[cfg(feature = "viewer")]
mod view;

use crate::error::{Error, Result};
use crate::image::extension;
use crate::scene::{Camera, Origin, Scene};
use args::{Args, Command, SceneOptions};
use clap::Parser;
use clap::error::ContextKind;
use indicatif::ProgressBar;
use std::path::Path;
use std::process::ExitCode;

/// Frames a second along a camera's path, and of lights that move.
const FRAME_RATE: f64 = 30.0;

/// Parses the command line and runs it; errors go to stderr.
#[must_use]
pub fn main() -> ExitCode {
    let args = Args::try_parse().unwrap_or_else(|error| refuse(&error));
    let result = match args.command.unwrap_or_default() {
        Command::Render(options) => render::run(&options),
        #[cfg(feature = "viewer")]
        Command::View(options) => view::run(&options),
        #[cfg(not(feature = "viewer"))]
        Command::View(_) => Err(Error::usage(
            "this amas was built without the window",
            "build it with the default feature `viewer`, or use `amas render`",
        )),
        Command::Reference(options) => reference::run(&options),
        Command::Compare(options) => compare::run(&options),
        Command::Fit(options) => fit::run(&options),
        Command::Bench(options) => bench::run(&options),
        Command::Report(options) => curves::run(&options),
        Command::Info(options) => info::run(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            terminal::complain(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

/// Says what is wrong with the command line, or shows the help that it asks for.
fn refuse(error: &clap::Error) -> ! {
    let word = error.get(ContextKind::InvalidSubcommand).map(ToString::to_string);
    match word.filter(|word| ["toml", "obj"].contains(&extension(Path::new(word)).as_str())) {
        Some(scene) => {
            let remedy = format!("write `amas render {scene}` or `amas view {scene}`");
            let error = Error::usage(format!("{scene} is no subcommand"), remedy);
            terminal::complain(&error);
            std::process::exit(error.exit_code().into())
        }
        None => error.exit(),
    }
}

/// Loads the scene that the options name, or the embedded one, and says what loading repaired.
fn load_scene(options: &SceneOptions) -> Result<Scene> {
    load_watched(options, &ProgressBar::hidden())
}

/// As [`load_scene`]; see [`Origin::load`] for `progress`.
fn load_watched(options: &SceneOptions, progress: &ProgressBar) -> Result<Scene> {
    let scene = options.origin().load(&options.overrides(), progress);
    let scene = scene.map_err(|error| of_size(error, options.size))?;
    for warning in &scene.warnings {
        terminal::complain(format_args!("warning: {warning}"));
    }
    warn_of_darkness(options, &scene);
    Ok(scene)
}

/// Says that there is nothing that could be seen.
fn warn_of_darkness(options: &SceneOptions, scene: &Scene) {
    let lights = scene.point_lights.len() + scene.area_lights.len();
    if let Some(path) = &options.scene
        && lights == 0
        && scene.render.background == [0.0; 3]
    {
        terminal::complain(format_args!(
            "warning: {}: the scene has no light, and its background is black: so will the picture be\n  remedy: add a [[light]], \
             or give `background` in [render]",
            path.display()
        ));
    }
}

/// Blames `--size` as it was given, not the override that it stands for.
fn of_size(error: Error, size: Option<[u32; 2]>) -> Error {
    match (error, size) {
        (Error::Usage { cause, remedy }, Some([width, height])) => {
            let given = cause.strip_prefix(&format!("--set size=[{width}, {height}]"));
            let cause = given.map(|rest| format!("--size {width}x{height}{rest}")).unwrap_or(cause.clone());
            Error::Usage { cause, remedy }
        }
        (error, _) => error,
    }
}

impl SceneOptions {
    fn origin(&self) -> Origin<'_> {
        self.scene.as_deref().map_or(default_scene::ORIGIN, Origin::File)
    }

    /// With the size, as it were one of them.
    fn overrides(&self) -> Vec<(String, String)> {
        let size = self.size.map(|[width, height]| ("size".into(), format!("[{width}, {height}]")));
        self.set.iter().cloned().chain(size).collect()
    }
}

/// Says once what light a single frame leaves out.
fn warn_of_gathered_light(scene: &Scene) {
    let points = scene.render.shadows && !scene.point_lights.is_empty();
    if points || scene.render.vpls > 0 {
        terminal::complain(
            "warning: indirect light and point lights with shadows are gathered over many frames, which are left out here\n  \
             remedy: use `amas render` for them, or --set indirect.vpls=0 and --set shadows=false",
        );
    }
}

/// Names the scene's file in what an error says of the scene's content.
fn in_scene<T>(options: &SceneOptions, result: Result<T>) -> Result<T> {
    result.map_err(|error| match (error, &options.scene) {
        (Error::Usage { cause, remedy }, Some(path)) => Error::input(path, None, cause, remedy),
        (error, _) => error,
    })
}

/// The camera of that name, or the first.
fn camera<'a>(scene: &'a Scene, name: Option<&str>) -> Result<&'a Camera> {
    camera_index(scene, name).map(|index| &scene.cameras[index])
}

/// As [`camera`]: which of the scene's cameras it is.
fn camera_index(scene: &Scene, name: Option<&str>) -> Result<usize> {
    let names = || scene.cameras.iter().map(|camera| camera.name.as_str()).collect::<Vec<_>>().join(", ");
    let found = match name {
        Some(name) => scene.cameras.iter().position(|camera| camera.name == name),
        None => (!scene.cameras.is_empty()).then_some(0),
    };
    found.ok_or_else(|| {
        Error::usage(
            format!("the scene has no camera {}", name.map_or_else(String::new, |name| format!("{name:?}"))),
            format!("choose one of: {}", names()),
        )
    })
}
