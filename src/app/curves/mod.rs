//! `amas report`: speed against error, measured on the device, a chapter a module.

mod area;
mod choices;
mod features;
mod hard;
mod indirect;
mod letters;
mod lights;
mod plot;
mod samples;
mod scaling;
mod subject;

use super::args::{Chapter, ReportOptions};
use super::outputs::{check_folder, make_folder};
use super::report;
use super::terminal::print;
use crate::error::Result;
use crate::gpu::Device;
use crate::image::write_atomically;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A chapter: the files that it writes, and what measures and writes it and says what is printed.
struct Row {
    chapter: Chapter,
    files: &'static [&'static str],
    run: fn(&Arc<Device>, bool, &Path) -> Result<String>,
}

/// Every chapter, in the order in which they run.
const CHAPTERS: [Row; 8] = [
    Row { chapter: Chapter::Area, files: &area::FILES, run: area::run },
    Row { chapter: Chapter::Lights, files: &lights::FILES, run: lights::run },
    Row { chapter: Chapter::Indirect, files: &indirect::FILES, run: indirect::run },
    Row { chapter: Chapter::Hard, files: &hard::FILES, run: hard::run },
    Row { chapter: Chapter::Features, files: &features::FILES, run: features::run },
    Row { chapter: Chapter::Scaling, files: &scaling::FILES, run: scaling::run },
    Row { chapter: Chapter::Samples, files: &samples::FILES, run: samples::run },
    Row { chapter: Chapter::Choices, files: &choices::FILES, run: choices::run },
];

pub(super) fn run(options: &ReportOptions) -> Result<()> {
    make_folder(&options.out)?;
    let wanted = |row: &&Row| options.chapter.is_none_or(|only| only == row.chapter);
    let files = CHAPTERS.iter().filter(wanted).flat_map(|row| row.files);
    files.into_iter().try_for_each(|name| check_folder(&options.out.join(name)))?;
    let device = Device::open(&options.device.asked())?;
    for row in CHAPTERS.iter().filter(wanted) {
        print((row.run)(&device, options.quick, &options.out)?)?;
    }
    Ok(())
}

/// Writes a chapter's tables, CSV, JSON and Markdown, each to its path.
fn save_tables(
    [csv, json, markdown]: [&PathBuf; 3],
    rows: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    content: &impl Serialize,
    page: &str,
) -> Result<()> {
    write_atomically(csv, rows)?;
    report::save(json, content)?;
    write_atomically(markdown, |file| file.write_all(page.as_bytes()))
}

/// What a table's last column says of a point: whether it is on the front of Pareto's, and what ships.
fn marks(pareto: bool, default: bool) -> &'static str {
    match (pareto, default) {
        (true, true) => "front, default",
        (true, false) => "front",
        (false, true) => "default",
        (false, false) => "",
    }
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

/// Of the line through the logarithms of both coordinates that is nearest to them in squares of the second.
fn slope(places: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let logs = places.map(|(x, y)| (x.ln(), y.ln()));
    let count = logs.clone().count() as f64;
    let [x, y] =
        [|p: (f64, f64)| p.0, |p: (f64, f64)| p.1].map(|of| logs.clone().map(of).sum::<f64>() / count);
    let sums = logs.fold((0.0, 0.0), |(xy, xx), p| (xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x).powi(2)));
    sums.0 / sums.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a power law, its exponent; of what falls and rises alike, none.
    #[test]
    fn slopes() {
        let law = |k: f64| (1..7).map(move |n| (10_f64.powi(n), 3.0 * 10_f64.powi(n).powf(k)));
        for k in [0.0, 0.5, 1.0, 2.0] {
            assert!((slope(law(k)) - k).abs() < 1e-12, "{k}");
        }
        let noisy = [(1.0, 2.0), (2.0, 1.0), (4.0, 1.0), (8.0, 2.0)];
        assert!(slope(noisy.into_iter()).abs() < 1e-12);
    }
}
