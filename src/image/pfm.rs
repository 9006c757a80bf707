//! Portable float map: a text header of three words, then float32 rows from the bottom up.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use super::HdrImage;
use crate::{Error, Result};

/// Reads colour (`PF`) and grey (`Pf`); a negative scale means little-endian, its magnitude is ignored.
pub(super) fn load(path: &Path) -> Result<HdrImage> {
    let bytes = fs::read(path)
        .map_err(|error| Error::input(path, None, error.to_string(), "check the path and its rights"))?;
    parse(&bytes).map_err(|cause| {
        let remedy = "the file is damaged or no PFM file; write it again";
        Error::input(path, None, cause, remedy)
    })
}

fn parse(bytes: &[u8]) -> std::result::Result<HdrImage, String> {
    let mut rest = bytes;
    let channels = match word(&mut rest) {
        Some("PF") => 3,
        Some("Pf") => 1,
        _ => return Err("a PFM file starts with \"PF\" or \"Pf\"".into()),
    };
    let width: u32 = number(&mut rest, "width")?;
    let height: u32 = number(&mut rest, "height")?;
    let scale: f64 = number(&mut rest, "scale")?;
    let row = width as usize * channels * 4;
    let need = row.checked_mul(height as usize).ok_or("the picture is too large")?;
    if need == 0 {
        return Err("the picture has no pixels".into());
    }
    if rest.len() < need {
        return Err(format!("{need} bytes of pixels are announced, {} are there", rest.len()));
    }
    let decode: fn([u8; 4]) -> f32 = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let value = |b: &[u8]| decode([b[0], b[1], b[2], b[3]]);
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    for line in rest[..need].chunks_exact(row).rev() {
        pixels.extend(line.chunks_exact(channels * 4).map(|pixel| match channels {
            1 => [value(pixel); 3],
            _ => [value(&pixel[0..]), value(&pixel[4..]), value(&pixel[8..])],
        }));
    }
    Ok(HdrImage { width, height, pixels })
}

/// The next word of the header; eats exactly one white space after it, because pixels may follow.
fn word<'a>(rest: &mut &'a [u8]) -> Option<&'a str> {
    let start = rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
    let length = rest[start..].iter().position(u8::is_ascii_whitespace)?;
    let word = &rest[start..start + length];
    *rest = &rest[start + length + 1..];
    std::str::from_utf8(word).ok()
}

fn number<T: std::str::FromStr>(rest: &mut &[u8], what: &str) -> std::result::Result<T, String> {
    word(rest)
        .and_then(|word| word.parse().ok())
        .ok_or_else(|| format!("the header's {what} is missing or no number"))
}

/// Writes colour, little-endian.
pub(super) fn write(image: &HdrImage, file: &mut impl Write) -> io::Result<()> {
    write!(file, "PF\n{} {}\n-1.0\n", image.width, image.height)?;
    for row in image.pixels.chunks(image.width.max(1) as usize).rev() {
        for value in row.as_flattened() {
            file.write_all(&value.to_le_bytes())?;
        }
    }
    Ok(())
}
