//! `amas render`: a scene file to pictures.

use super::aovs::{AovOutput, Source};
use super::args::RenderOptions;
use super::outputs::{
    Kind, check_distinct, check_folder, check_frames, check_picture, check_single, frame_path, kind,
};
use super::refine::Refining;
use super::report::{self, Report};
use super::{FRAME_RATE, camera, in_scene, load_scene};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::image::save_png8;
use crate::refine::Rounds;
use indicatif::ProgressBar;
use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::Arc;

pub(super) fn run(options: &RenderOptions) -> Result<()> {
    let mut outputs = options.output.clone();
    if outputs.is_empty() && options.aov.is_empty() {
        outputs.push(if options.frames.is_some() { "amas_%04d.png" } else { "amas.png" }.into());
    }
    let aovs = options.aov.iter().map(AovOutput::new).collect::<Result<Vec<_>>>()?;
    check_outputs(options, &outputs, &aovs)?;
    let scene = load_scene(&options.scene)?;
    let camera = in_scene(&options.scene, camera(&scene, options.camera.as_deref()))?;
    let device = Device::open(&options.device.asked())?;
    let gpu_scene = Arc::new(in_scene(&options.scene, GpuScene::new(&device, &scene))?);
    let settings = FrameSettings::new(&scene.render, camera);
    let mut frame = Frame::new(&device, &gpu_scene, settings)?;

    let frames = options.frames.clone().unwrap_or(0..1);
    let bar = progress(frames.len() as u64 * u64::from(scene.render.samples));
    let mut timings = Vec::new();
    let mut rounds = None;
    let mut refining = Refining::start(&options.refine, frame.gathers())?;
    for index in frames {
        let time = f64::from(index) / FRAME_RATE;
        let placed = if options.frames.is_some() { camera.at(time) } else { camera.clone() };
        let inputs = FrameInputs {
            camera: &placed,
            time,
            samples: scene.render.samples,
            exposure: scene.render.exposure,
            split: options.report.is_some(),
            progress: bar.clone(),
        };
        let mut taken = frame.render(&inputs)?;
        if let Some(refining) = &mut refining {
            if gpu_scene.moves() {
                rounds = None;
            }
            let made = || Rounds::new(&scene, gpu_scene.origin, frame.gathers(), time);
            let rounds = rounds.get_or_insert_with(made);
            taken.add(&refining.refine(&mut frame, rounds, &device, &inputs)?);
        }
        timings.push(taken);
        save(&frame, settings.size, (&outputs, index))?;
        let source = Source { device: &device, gpu_scene: &gpu_scene, scene: &scene, camera: &placed, time };
        source.save(&mut frame, &aovs, index)?;
        if refining.as_ref().is_some_and(Refining::interrupted) {
            break;
        }
    }
    bar.finish_and_clear();
    report::warn_of_overflow(&frame.counters(), settings.max_lights_per_cluster);
    let info = device.info();
    let [width, height] = settings.size;
    report::print_table(
        &format!("{} ({}), {width}x{height}", info.name, info.driver),
        &report::passes(&timings, &timings),
        &timings,
    )?;
    let error = refining.as_ref().map_or(Some(0.0), Refining::worst);
    if let Some(path) = &options.report {
        report::save(path, &Report::new(&device, &scene, &frame, (&timings, error))?)?;
    }
    device.require_silence()?;
    refining.map_or(Ok(()), Refining::end)
}

fn check_outputs(options: &RenderOptions, outputs: &[PathBuf], aovs: &[AovOutput]) -> Result<()> {
    outputs.iter().try_for_each(|path| check_picture(path).map(|_| ()))?;
    aovs.iter().try_for_each(AovOutput::check)?;
    options.report.iter().try_for_each(|path| check_folder(path).and_then(|()| check_single(path)))?;
    let files: Vec<PathBuf> = outputs.iter().chain(aovs.iter().map(|aov| &aov.file)).cloned().collect();
    check_distinct(files.iter().chain(&options.report), options.scene.scene.as_deref())?;
    check_frames(&files, options.frames.clone().map_or(1, |frames| frames.len() as u32))
}

/// A bar on a terminal, nothing in a pipe or for a single sample.
fn progress(samples: u64) -> ProgressBar {
    if samples > 1 && std::io::stderr().is_terminal() {
        ProgressBar::new(samples)
    } else {
        ProgressBar::hidden()
    }
}

fn save(frame: &Frame, [width, height]: [u32; 2], (outputs, index): (&[PathBuf], u32)) -> Result<()> {
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
    Ok(())
}
