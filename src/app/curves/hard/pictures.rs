//! Whole pictures of scenes on which clusters and virtual lights break: against the picture that needs neither.

use super::worlds::{WORLDS, World};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::image::HdrImage;
use crate::reference::{self, Integrator, Options};
use crate::refine::Rounds;
use crate::scene::Scene;
use crate::shared::GATHER_FRAMES;
use indicatif::ProgressBar;
use serde::Serialize;
use std::sync::Arc;

/// Values below this share of the picture's mean are judged by it.
const FLOOR: f64 = 1e-3;
/// Rounds of gathered light.
const ROUNDS: u32 = 2;
/// Paths a pixel of what gathered light is compared with.
const PATHS: u32 = 256;

/// A scene's picture.
#[derive(Serialize)]
pub(super) struct Picture {
    pub(super) what: &'static str,
    pub(super) case: &'static str,
    /// Of the picture, and of what it is compared with.
    pub(super) largest: [f64; 2],
    /// Of clusters: worst relative error. Of gathered light: largest value over the largest of the paths; `null` where these
    /// bring nothing, and the largest value is the error.
    pub(super) worst: Option<f64>,
    /// Values that are infinite or no numbers.
    pub(super) not_finite: usize,
}

pub(super) fn judge(device: &Arc<Device>, bar: &ProgressBar) -> Result<Vec<Picture>> {
    let one = |world: &World| {
        bar.set_message(world.case);
        let scene = world.scene()?;
        let picture = if world.gathered { gathered(device, &scene)? } else { clustered(device, &scene)? };
        bar.inc(1);
        Ok(Picture { what: world.what(), case: world.case, ..picture })
    };
    WORLDS.iter().map(one).collect()
}

/// With lists, and with every light on every pixel.
fn clustered(device: &Arc<Device>, scene: &Scene) -> Result<Picture> {
    let gpu_scene = Arc::new(GpuScene::new(device, scene)?);
    let settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
    let picture = |settings| -> Result<HdrImage> {
        let mut frame = Frame::new(device, &gpu_scene, settings)?;
        frame.render(&inputs(scene))?;
        frame.hdr()
    };
    let [got, want] =
        [picture(settings)?, picture(FrameSettings { brute_force: true, ..settings })?].map(|p| values(&p));
    let floor = FLOOR * want.iter().sum::<f64>() / want.len() as f64;
    let errors = got.iter().zip(&want).filter(|pair| pair.0.is_finite());
    let worst = errors.map(|(got, want)| (got - want).abs() / want.max(floor).max(f64::MIN_POSITIVE));
    Ok(Picture { worst: Some(worst.fold(0.0, f64::max)), ..compared(&got, &want) })
}

/// Gathered light, and paths in double precision.
fn gathered(device: &Arc<Device>, scene: &Scene) -> Result<Picture> {
    let gpu_scene = Arc::new(GpuScene::new(device, scene)?);
    let settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
    let mut frame = Frame::new(device, &gpu_scene, settings)?;
    frame.render(&inputs(scene))?;
    let rounds = Rounds::new(scene, gpu_scene.origin, frame.gathers(), 0.0);
    for number in 0..ROUNDS {
        rounds.light(&mut frame, device, number)?;
        (0..GATHER_FRAMES).try_for_each(|_| frame.gather(&inputs(scene)).map(|_| ()))?;
    }
    let got =
        frame.gathered_light()?.map_or_else(Vec::new, |[indirect, points]| values(&indirect.plus(&points)));
    // Point lights' own light is gathered, too.
    let fewest_bounces = u32::from(scene.point_lights.is_empty());
    let options = Options {
        integrator: Integrator::Path,
        paths: PATHS,
        fewest_bounces,
        bounces: scene.render.bounces,
        ..Options::of_scene(scene)
    };
    let want = values(&reference::render(scene, &scene.cameras[0], &options)?.image);
    let picture = compared(&got, &want);
    let [most, of_paths] = picture.largest;
    Ok(Picture { worst: (of_paths > 0.0).then(|| most / of_paths), ..picture })
}

fn compared(got: &[f64], want: &[f64]) -> Picture {
    let largest = |values: &[f64]| values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let not_finite = got.iter().filter(|value| !value.is_finite()).count();
    Picture { what: "", case: "", largest: [largest(got), largest(want)], worst: None, not_finite }
}

fn values(image: &HdrImage) -> Vec<f64> {
    image.pixels.iter().flatten().map(|&value| f64::from(value)).collect()
}

fn inputs(scene: &Scene) -> FrameInputs<'_> {
    FrameInputs {
        camera: &scene.cameras[0],
        time: 0.0,
        samples: 1,
        exposure: 0.0,
        split: false,
        progress: ProgressBar::hidden(),
    }
}
