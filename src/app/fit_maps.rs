//! Pictures and CSV files of what `amas fit` found.

use super::fit::Summary;
use crate::error::Result;
use crate::image::{save_png8, write_atomically};
use crate::ltc::{Cell, Fitted};
use std::io::Write;
use std::path::Path;

/// File of all layers' figures.
pub(super) const SUMMARY: &str = "summary.csv";
/// Pixels of a half texel's side.
const SCALE: usize = 4;
/// Pixels between two maps.
const GAP: usize = 8;

/// A figure, and the value that is white.
type Map = (fn(&Cell) -> f64, f64);

/// What the maps show, from left to right.
const MAPS: [Map; 4] = [
    (|cell| cell.table.variation, 0.3),
    (|cell| cell.table.variation - cell.fitted, 0.01),
    (|cell| cell.table.leak, 0.05),
    (|cell| cell.table.peak_shift, 20.0),
];

/// `<layer>.png` and `<layer>.csv`.
pub(super) fn write(folder: &Path, fitted: &Fitted) -> Result<()> {
    let name = fitted.table.layer.name();
    let (width, height, pixels) = maps(fitted);
    save_png8(folder.join(format!("{name}.png")), width as u32, height as u32, &pixels)?;
    write_atomically(folder.join(format!("{name}.csv")), |file| {
        writeln!(file, "r,cos,albedo,tv,bound,leak,peak_shift_deg,peak_height")?;
        let texel = |cell: &&Cell| cell.column.fract() == 0.0 && cell.row.fract() == 0.0;
        fitted.cells.iter().filter(texel).try_for_each(|cell| {
            let (at, found) = (cell.parameters, cell.table);
            writeln!(
                file,
                "{:.4},{:.4},{:.5},{:.4},{:.4},{:.4},{:.2},{:.3}",
                at.r,
                at.cos,
                cell.albedo,
                found.variation,
                found.bound,
                found.leak,
                found.peak_shift,
                found.peak_height
            )
        })
    })
}

/// [`SUMMARY`].
pub(super) fn write_summary(folder: &Path, rows: &[Summary]) -> Result<()> {
    write_atomically(folder.join(SUMMARY), |file| {
        writeln!(file, "layer,tv_mean,tv_max,leak_max,excess_mean,excess_max,bound_max")?;
        rows.iter().try_for_each(|row| {
            let ([tv, tv_max], [excess, excess_max]) = (row.variation, row.excess);
            let (layer, leak, bound) = (row.layer.name(), row.leak, row.bound);
            writeln!(file, "{layer},{tv:.4},{tv_max:.4},{leak:.4},{excess:.5},{excess_max:.5},{bound:.4}")
        })
    })
}

/// All of [`MAPS`] side by side: r to the right, √(1 − n·wo) downwards.
fn maps(fitted: &Fitted) -> (usize, usize, Vec<[u8; 3]>) {
    let [columns, rows] = fitted.table.size.map(|side| 2 * side as usize - 1);
    // A table of one column is shown wide enough to see.
    let across = SCALE * (64 / columns).clamp(1, 16);
    let (panel, height) = (columns * across, rows * SCALE);
    let width = MAPS.len() * (panel + GAP) - GAP;
    let mut pixels = vec![[255; 3]; width * height];
    for (map, (value, white)) in MAPS.into_iter().enumerate() {
        for (y, line) in pixels.chunks_exact_mut(width).enumerate() {
            let begin = map * (panel + GAP);
            for (x, pixel) in line[begin..begin + panel].iter_mut().enumerate() {
                *pixel = heat(value(&fitted.cells[y / SCALE * columns + x / across]) / white);
            }
        }
    }
    (width, height, pixels)
}

/// Black, red, yellow, white.
fn heat(t: f64) -> [u8; 3] {
    [0.0, 1.0, 2.0].map(|begin| (255.0 * (3.0 * t - begin).clamp(0.0, 1.0)).round() as u8)
}
