//! `amas report`: speed against error, measured on the device, a chapter a module.

mod area;
mod letters;
mod lights;
mod plot;

use super::args::{Chapter, ReportOptions};
use super::outputs::check_folder;
use super::terminal::print;
use crate::error::Result;
use crate::gpu::{Device, Options};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

pub(super) fn run(options: &ReportOptions) -> Result<()> {
    let wanted = |chapter| options.chapter.is_none_or(|only| only == chapter);
    let area = area::FILES.map(|name| options.out.join(name));
    let lights = lights::FILES.map(|name| options.out.join(name));
    let all = [(Chapter::Area, &area), (Chapter::Lights, &lights)];
    let written = all.into_iter().filter(|(chapter, _)| wanted(*chapter)).flat_map(|(_, files)| files);
    written.into_iter().try_for_each(|path| check_folder(path))?;
    let device =
        Device::open(&Options { device: options.device.device.clone(), validate: options.device.validate })?;
    if wanted(Chapter::Area) {
        let figures = area::measure(&device, options.quick)?;
        device.require_silence()?;
        area::write(&area, device.info(), &figures)?;
        print(area::summary(&figures))?;
    }
    if wanted(Chapter::Lights) {
        let figures = lights::measure(&device, options.quick)?;
        device.require_silence()?;
        lights::write(&lights, device.info(), &figures)?;
        print(lights::summary(&figures))?;
    }
    Ok(())
}

fn progress(work: usize) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(work as u64);
    match ProgressStyle::with_template("report {bar:40} {percent} % {msg}, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
