//! `amas render`: a scene file to pictures.

use super::args::RenderOptions;
use super::outputs::{
    Kind, check_distinct, check_folder, check_frames, check_linear, check_picture, frame_path, kind,
};
use super::report::{self, Report};
use super::{camera, in_scene, load_scene, warn_of_missing_shadows};
use crate::error::{Error, Result};
use crate::frame::{Frame, FrameInputs, FrameSettings, Timings};
use crate::gpu::{Device, Options};
use crate::gpu_scene::GpuScene;
use crate::image::{HdrImage, save_png8};
use crate::passes::aov::Quantity;
use crate::scene::{Camera, Scene};
use indicatif::ProgressBar;
use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::Arc;

/// Frames a second along a camera's path.
const FRAME_RATE: f64 = 30.0;

/// An output variable and its file.
struct AovOutput {
    variable: Variable,
    file: PathBuf,
}

#[derive(Clone, Copy)]
enum Variable {
    Surface(Quantity),
    /// Light of the scene's own lights, without background.
    Direct,
    /// Light of virtual lights, of which there are none yet.
    Indirect,
}

pub(super) fn run(options: &RenderOptions) -> Result<()> {
    let mut outputs = options.output.clone();
    if outputs.is_empty() && options.aov.is_empty() {
        outputs.push(if options.frames.is_some() { "amas_%04d.png" } else { "amas.png" }.into());
    }
    let aovs = options.aov.iter().map(aov_output).collect::<Result<Vec<_>>>()?;
    check_outputs(options, &outputs, &aovs)?;
    let scene = load_scene(&options.scene)?;
    let camera = in_scene(&options.scene, camera(&scene, options.camera.as_deref()))?;
    let device =
        Device::open(&Options { device: options.device.device.clone(), validate: options.device.validate })?;
    let gpu_scene = Arc::new(in_scene(&options.scene, GpuScene::new(&device, &scene))?);
    warn_of_missing_shadows(&scene);
    let settings = FrameSettings::new(&scene.render, camera);
    let mut frame = Frame::new(&device, &gpu_scene, settings)?;

    let frames = options.frames.clone().unwrap_or(0..1);
    let bar = progress(frames.len() as u64 * u64::from(scene.render.samples));
    let mut timings = Vec::new();
    for index in frames {
        let placed = match options.frames {
            Some(_) => camera.at(f64::from(index) / FRAME_RATE),
            None => camera.clone(),
        };
        let inputs = FrameInputs {
            camera: &placed,
            samples: scene.render.samples,
            exposure: scene.render.exposure,
            split: options.report.is_some(),
            progress: bar.clone(),
        };
        timings.push(picture(&mut frame, &inputs, settings.size, (&outputs, index))?);
        save_aovs(&device, &gpu_scene, &mut frame, &scene, &placed, (&aovs, index))?;
    }
    bar.finish_and_clear();
    report::warn_of_overflow(&frame.counters(), settings.max_lights_per_cluster);
    let info = device.info();
    let [width, height] = settings.size;
    report::print_table(
        &format!("{} ({}), {width}x{height}", info.name, info.driver),
        &report::passes(&timings),
        &timings,
    )?;
    if let Some(path) = &options.report {
        report::save(path, &Report::new(&device, &scene, &frame, &timings)?)?;
    }
    device.require_silence()
}

fn check_outputs(options: &RenderOptions, outputs: &[PathBuf], aovs: &[AovOutput]) -> Result<()> {
    outputs.iter().try_for_each(|path| check_picture(path).map(|_| ()))?;
    aovs.iter().try_for_each(|aov| check_linear(&aov.file))?;
    options.report.iter().try_for_each(|path| check_folder(path))?;
    let files: Vec<PathBuf> = outputs.iter().chain(aovs.iter().map(|aov| &aov.file)).cloned().collect();
    check_distinct(files.iter().chain(&options.report), options.scene.scene.as_deref())?;
    check_frames(&files, options.frames.clone().map_or(1, |frames| frames.len() as u32))
}

fn aov_output((name, file): &(String, String)) -> Result<AovOutput> {
    let variable = match name.as_str() {
        "position" => Variable::Surface(Quantity::Position),
        "normal" => Variable::Surface(Quantity::Normal),
        "material" => Variable::Surface(Quantity::Material),
        "light_count" => Variable::Surface(Quantity::LightCount),
        "direct" => Variable::Direct,
        "indirect" => Variable::Indirect,
        _ => {
            return Err(Error::usage(
                format!("there is no output variable {name:?}"),
                "choose position, normal, material, light_count, direct or indirect",
            ));
        }
    };
    Ok(AovOutput { variable, file: file.into() })
}

/// A bar on a terminal, nothing in a pipe or for a single sample.
fn progress(samples: u64) -> ProgressBar {
    if samples > 1 && std::io::stderr().is_terminal() {
        ProgressBar::new(samples)
    } else {
        ProgressBar::hidden()
    }
}

fn picture(
    frame: &mut Frame,
    inputs: &FrameInputs<'_>,
    [width, height]: [u32; 2],
    (outputs, index): (&[PathBuf], u32),
) -> Result<Timings> {
    let timings = frame.render(inputs)?;
    for output in outputs {
        let path = frame_path(output, index);
        match kind(output)? {
            Kind::Display => {
                let pixels: Vec<[u8; 3]> = frame.ldr()?.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
                save_png8(&path, width, height, &pixels)?;
            }
            Kind::Linear => frame.hdr()?.save(&path)?,
        }
    }
    Ok(timings)
}

fn save_aovs(
    device: &Arc<Device>,
    gpu_scene: &Arc<GpuScene>,
    frame: &mut Frame,
    scene: &Scene,
    camera: &Camera,
    (aovs, index): (&[AovOutput], u32),
) -> Result<()> {
    // Variables are those of the pixel's centre, and of light alone.
    let inputs =
        FrameInputs { camera, samples: 1, exposure: 0.0, split: false, progress: ProgressBar::hidden() };
    if scene.render.samples > 1 && !aovs.is_empty() {
        frame.render(&inputs)?;
    }
    let [width, height] = scene.render.size;
    let image = |pixels| HdrImage { width, height, pixels };
    for aov in aovs {
        let path = frame_path(&aov.file, index);
        match aov.variable {
            Variable::Surface(quantity) => {
                image(frame.aov(quantity)?.iter().map(|&[x, y, z, _]| [x, y, z]).collect()).save(&path)?;
            }
            Variable::Direct => direct_light(device, gpu_scene, scene, camera)?.save(&path)?,
            Variable::Indirect => image(vec![[0.0; 3]; width as usize * height as usize]).save(&path)?,
        }
    }
    Ok(())
}

/// The picture without its background.
fn direct_light(
    device: &Arc<Device>,
    gpu_scene: &Arc<GpuScene>,
    scene: &Scene,
    camera: &Camera,
) -> Result<HdrImage> {
    let settings = FrameSettings { background: [0.0; 3], ..FrameSettings::new(&scene.render, camera) };
    let mut frame = Frame::new(device, gpu_scene, settings)?;
    let samples = scene.render.samples;
    frame.render(&FrameInputs {
        camera,
        samples,
        exposure: 0.0,
        split: false,
        progress: ProgressBar::hidden(),
    })?;
    frame.hdr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn unknown_variables_are_named() {
        let error = aov_output(&("albedo".into(), "a.exr".into())).err().map(|error| error.to_string());
        assert!(error.is_some_and(|text| text.contains("albedo") && text.contains("light_count")));
        assert!(check_linear(Path::new("a.png")).is_err());
    }
}
