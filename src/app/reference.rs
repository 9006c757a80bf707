//! `amas reference`: the double-precision oracle.

use super::args::{IntegratorName, ReferenceOptions};
use super::outputs::{check_distinct, check_linear};
use super::terminal::complain;
use super::{FRAME_RATE, camera, in_scene, load_scene};
use crate::error::Result;
use crate::reference::{Integrator, Options, render};
use crate::scene::RenderSettings;

/// Paths of each ray, where nothing is said.
const PATHS: u32 = 64;

pub(super) fn run(options: &ReferenceOptions) -> Result<()> {
    check_linear(&options.output)?;
    options.error.iter().try_for_each(|path| check_linear(path))?;
    check_distinct([&options.output].into_iter().chain(&options.error), options.scene.scene.as_deref())?;
    let mut scene = load_scene(&options.scene)?;
    let mut camera = in_scene(&options.scene, camera(&scene, options.camera.as_deref()))?.clone();
    if let Some(frame) = options.frame {
        let time = f64::from(frame) / FRAME_RATE;
        camera = camera.at(time);
        scene.point_lights = scene.point_lights_at(time);
    }
    warn_of_missing_light(&scene.render, options.integrator);
    warn_of_idle_options(options);
    let defaults = Options::of_scene(&scene);
    let rendered = render(
        &scene,
        &camera,
        &Options {
            spp: options.spp.unwrap_or(defaults.spp),
            seed: options.seed,
            integrator: match options.integrator {
                IntegratorName::Direct => Integrator::Direct,
                IntegratorName::Shadowed => Integrator::Shadowed,
                IntegratorName::Path => Integrator::Path,
            },
            tolerance: options.tolerance,
            paths: options.paths.unwrap_or(PATHS),
            bounces: options.bounces.unwrap_or(u32::MAX),
            progress: true,
            ..defaults
        },
    )?;
    rendered.image.save(&options.output)?;
    options.error.iter().try_for_each(|path| rendered.standard_error.save(path))
}

/// Each integrator computes what it is named after, whatever the scene asks for.
fn warn_of_missing_light(render: &RenderSettings, integrator: IntegratorName) {
    let (name, shadows, indirect) = match integrator {
        IntegratorName::Direct => ("direct", false, false),
        IntegratorName::Shadowed => ("shadowed", true, false),
        IntegratorName::Path => ("path", true, true),
    };
    let asked = [
        (render.shadows && !shadows, "shadows", "shadowed", "shadows=false"),
        (render.vpls > 0 && !indirect, "indirect light", "path", "indirect.vpls=0"),
    ];
    for (missing, what, remedy, none) in asked {
        if missing {
            complain(format_args!(
                "warning: the scene asks for {what}; the {name} integrator leaves that out\n  remedy: choose --integrator {remedy}, \
                 or --set {none}"
            ));
        }
    }
}

/// Says which options the integrator does not look at.
fn warn_of_idle_options(options: &ReferenceOptions) {
    if matches!(options.integrator, IntegratorName::Path) {
        return;
    }
    for (name, given) in [("--paths", options.paths.is_some()), ("--bounces", options.bounces.is_some())] {
        if given {
            complain(format_args!(
                "warning: {name} is for the path integrator only, and means nothing here\n  remedy: add --integrator path, or \
                 leave it out"
            ));
        }
    }
}
