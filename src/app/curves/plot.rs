//! Plots as files, vector and bitmap.

use super::letters::Lettered;
use crate::error::{Error, Result};
use crate::image::{save_png8, write_atomically};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A font that vector pictures leave to the viewer, and bitmaps replace by their own.
pub(super) const FONT: (&str, i32) = ("monospace", 13);
pub(super) const TITLE: (&str, i32) = ("monospace", 18);

pub(super) type Drawn<B> = std::result::Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

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

/// Without a tail of digits.
pub(super) fn number(value: f64) -> String {
    let digits = (-value.log10().floor()).max(0.0) as usize;
    format!("{value:.digits$}")
}
