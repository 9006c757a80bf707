//! `amas report`: speed against error, measured on the device. One chapter so far, area lights; a chapter is a module
//! with its files and a `run`.

mod area;
mod configurations;
mod figures;
mod letters;
mod page;
mod plot;
mod tiers;

use super::args::ReportOptions;
use super::outputs::check_folder;
use super::terminal::print;
use crate::error::Result;
use crate::gpu::{Device, Options};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

pub(super) fn run(options: &ReportOptions) -> Result<()> {
    let files = area::FILES.map(|name| options.out.join(name));
    files.iter().try_for_each(|path| check_folder(path))?;
    let device =
        Device::open(&Options { device: options.device.device.clone(), validate: options.device.validate })?;
    let figures = area::measure(&device, options.quick)?;
    device.require_silence()?;
    area::write(&files, device.info(), &figures)?;
    print(page::summary(&figures))
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
