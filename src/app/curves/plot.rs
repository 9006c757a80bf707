//! Plots as files, vector and bitmap.

use super::letters::Lettered;
use crate::error::{Error, Result};
use crate::image::{save_png8, write_atomically};
use plotters::coord::Shift;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A font that vector pictures leave to the viewer, and bitmaps replace by their own.
pub(super) const FONT: (&str, i32) = ("monospace", 13);
const TITLE: (&str, i32) = ("monospace", 18);

/// Lines of the mesh: light, bold.
pub(super) const GRID: [RGBColor; 2] = [RGBColor(240, 240, 240), RGBColor(215, 215, 215)];

pub(super) type Drawn<B, T = ()> =
    std::result::Result<T, DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;
/// Both axes logarithmic.
pub(super) type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// What is drawn.
pub(super) trait Plot {
    /// Pixels.
    const SIZE: (u32, u32);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B>;
}

/// Draws it as SVG and as PNG, each to its path.
pub(super) fn save<P: Plot>([to_svg, to_png]: [&PathBuf; 2], plot: &P) -> Result<()> {
    svg(to_svg, plot)?;
    png(to_png, plot)
}

fn svg<P: Plot>(path: &Path, plot: &P) -> Result<()> {
    let mut text = String::new();
    let root = SVGBackend::with_string(&mut text, P::SIZE).into_drawing_area();
    plot.draw(&root).map_err(|error| failed(path, error))?;
    drop(root);
    write_atomically(path, |file| file.write_all(text.as_bytes()))
}

fn png<P: Plot>(path: &Path, plot: &P) -> Result<()> {
    let mut bytes = vec![0; 3 * (P::SIZE.0 * P::SIZE.1) as usize];
    let root = Lettered(BitMapBackend::with_buffer(&mut bytes, P::SIZE)).into_drawing_area();
    plot.draw(&root).map_err(|error| failed(path, error))?;
    drop(root);
    let pixels: Vec<[u8; 3]> = bytes.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    save_png8(path, P::SIZE.0, P::SIZE.1, &pixels)
}

fn failed(path: &Path, error: impl ToString) -> Error {
    Error::Write { file: path.to_path_buf(), source: io::Error::other(error.to_string()) }
}

/// A chart with nothing but its axes, of which `axes` says what they are.
pub(super) fn chart<'a, B: DrawingBackend>(
    panel: &'a DrawingArea<B, Shift>,
    title: &str,
    [across, up]: [Range<f64>; 2],
    axes: &str,
) -> Drawn<B, Chart<'a, B>> {
    let mut chart = ChartBuilder::on(panel)
        .margin(16)
        .caption(title, TITLE)
        .x_label_area_size(46)
        .y_label_area_size(64)
        .build_cartesian_2d(across.log_scale(), up.log_scale())?;
    chart
        .configure_mesh()
        .label_style(FONT)
        .x_desc(axes)
        .x_label_formatter(&|value| number(*value))
        .y_label_formatter(&|value| number(*value))
        .light_line_style(GRID[0])
        .bold_line_style(GRID[1])
        .draw()?;
    Ok(chart)
}

/// Of axes with room for all of these places, whose coordinates are `least` at least.
pub(super) fn ranges(places: impl Iterator<Item = (f64, f64)>, least: f64) -> [Range<f64>; 2] {
    let none = [(f64::MAX, least); 2];
    let ends = places.fold(none, |ends, (x, y)| {
        let wider = |(low, high): (f64, f64), at: f64| (low.min(at.max(least)), high.max(at));
        [wider(ends[0], x), wider(ends[1], y)]
    });
    ends.map(|(low, high)| low.min(high) / 1.6..high * 1.6)
}

/// Without a tail of digits.
fn number(value: f64) -> String {
    let digits = (-value.log10().floor()).max(0.0) as usize;
    format!("{value:.digits$}")
}
