//! Plots as files, vector and bitmap.

use super::letters::Lettered;
use crate::error::{Error, Result};
use crate::image::{save_png8, write_atomically};
use plotters::coord::Shift;
use plotters::coord::combinators::{LogCoord, WithKeyPoints};
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
/// Logarithmic.
type Axis = WithKeyPoints<LogCoord<f64>>;
/// Both axes logarithmic.
pub(super) type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<Axis, Axis>>;

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

/// What a point is called.
pub(super) struct Label {
    /// Where the point is, pixels.
    pub(super) at: (i32, i32),
    pub(super) text: String,
    pub(super) color: RGBColor,
    /// From where to where it may reach across.
    pub(super) within: [i32; 2],
}

/// What the axis takes at a panel's left.
const MARGIN: i32 = 80;

/// From where to where labels of a panel may reach.
pub(super) fn within<B: DrawingBackend>(panel: &DrawingArea<B, Shift>) -> [i32; 2] {
    let left = panel.get_base_pixel().0;
    [left + MARGIN, left + panel.dim_in_pixel().0 as i32]
}

/// Pixels of a letter, about, to keep labels apart.
const LETTER: [i32; 2] = [8, 15];

/// Labels go where nothing is: points first, then each label at the first free place beside its own.
pub(super) fn draw_labels<B: DrawingBackend>(root: &DrawingArea<B, Shift>, labels: &[Label]) -> Drawn<B> {
    let of_point = |label: &Label| {
        let (x, y) = label.at;
        [x - 7, y - 7, x + 7, y + 7]
    };
    let mut taken: Vec<[i32; 4]> = labels.iter().map(of_point).collect();
    for Label { at: (x, y), text, color, within } in labels {
        let [width, height] = [LETTER[0] * text.len() as i32, LETTER[1]];
        let places = [
            (x + 11, y - height / 2),
            (x - 11 - width, y - height / 2),
            (x + 8, y - height - 6),
            (x + 8, y + 6),
            (x - 8 - width, y - height - 6),
            (x - 8 - width, y + 6),
            (x - width / 2, y - height - 12),
            (x - width / 2, y + 12),
            (x + 8, y + 22),
            (x - 8 - width, y - height - 22),
        ];
        let free = |&(left, top): &(i32, i32)| {
            let inside = left > within[0] && left + width < within[1];
            let clear =
                |b: &[i32; 4]| left + width < b[0] || left > b[2] || top + height < b[1] || top > b[3];
            inside && taken.iter().all(clear)
        };
        let (left, top) = places.into_iter().find(free).unwrap_or(places[0]);
        taken.push([left, top, left + width, top + height]);
        root.draw_text(text, &FONT.into_font().color(color), (left, top))?;
    }
    Ok(())
}

/// Where a logarithmic axis has numbers: at powers of ten, and where it has less than two of these at their doubles and
/// fivefolds too.
fn ticks(range: &Range<f64>) -> Vec<f64> {
    let decades = range.start.log10().floor() as i32..=range.end.log10().floor() as i32;
    let multiples: &[f64] = if range.end < 100.0 * range.start { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let all = decades.flat_map(|decade| multiples.iter().map(move |multiple| multiple * 10_f64.powi(decade)));
    all.filter(|tick| range.contains(tick)).collect()
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
        .build_cartesian_2d(
            across.clone().log_scale().with_key_points(ticks(&across)),
            up.clone().log_scale().with_key_points(ticks(&up)),
        )?;
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
