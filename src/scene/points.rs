//! Many point lights at once: from a CSV file, or from a generator.

use std::ops::{Range, RangeInclusive};
use std::path::Path;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::light::PointLight;
use super::parse::LARGEST;
use crate::error::{Error, Result};

const HEADER_REMEDY: &str = "begin the file with the header x,y,z,r,g,b or x,y,z,r,g,b,range";
const COLUMNS: [&str; 7] = ["x", "y", "z", "r", "g", "b", "range"];

/// Reads a CSV of point lights: a header that names the columns x, y, z (metres), r, g, b (W·sr⁻¹) and perhaps
/// range (metres; empty, 0 or `inf` for none) in any order, then one light a line. Blank lines and lines that
/// begin with `#` are skipped.
///
/// # Errors
/// [`Error::Input`] with the line of a wrong header, field count or number.
pub(super) fn read_csv(file: &Path, text: &str) -> Result<Vec<PointLight>> {
    let mut start = 0;
    let mut lines = text.split_inclusive('\n').enumerate();
    let header = lines.find_map(|(index, line)| {
        start += line.len();
        meant(line).map(|line| (index + 1, line))
    });
    let Some((number, header)) = header else {
        return Err(Error::input(file, 1, "the file is empty", HEADER_REMEDY));
    };
    let columns = columns(header).map_err(|cause| Error::input(file, number, cause, HEADER_REMEDY))?;
    let parts: Vec<_> = parts(text, start, rayon::current_num_threads())
        .into_par_iter()
        .map(|part| (part.start, rows(&text[part], &columns)))
        .collect();
    let mut lights = Vec::new();
    for (start, rows) in parts {
        lights.append(&mut rows.map_err(|(index, cause)| {
            let number = 1 + text[..start].matches('\n').count() + index;
            let remedy = "write finite numbers: x,y,z in metres, r,g,b ≥ 0, range > 0 or empty";
            Error::input(file, number, cause, remedy)
        })?);
    }
    Ok(lights)
}

/// A line without the spaces around it, if it is not blank and no comment.
fn meant(line: &str) -> Option<&str> {
    let line = line.trim();
    (!line.is_empty() && !line.starts_with('#')).then_some(line)
}

/// The text from byte `start` on in about so many parts of whole lines.
fn parts(text: &str, start: usize, count: usize) -> Vec<Range<usize>> {
    let whole = |at: usize| match text.as_bytes()[at..].iter().position(|&byte| byte == b'\n') {
        Some(end) => at + end + 1,
        None => text.len(),
    };
    let mut begin = start;
    let part = |part: usize| {
        let end = whole((start + (text.len() - start) * part / count).max(begin));
        let begin = std::mem::replace(&mut begin, end);
        begin..end
    };
    (1..=count).map(part).collect()
}

/// Lights of whole lines, or the index of the first bad line and what is wrong with it.
fn rows(text: &str, columns: &[usize]) -> Result<Vec<PointLight>, (usize, String)> {
    let lines = text.lines().enumerate().filter_map(|(index, line)| Some((index, meant(line)?)));
    lines.map(|(index, line)| row(line, columns).map_err(|cause| (index, cause))).collect()
}

/// For each column of the file, its place in [`COLUMNS`].
fn columns(header: &str) -> Result<Vec<usize>, String> {
    let mut columns = Vec::new();
    for name in header.split(',').map(|name| name.trim().to_ascii_lowercase()) {
        let place = COLUMNS.iter().position(|column| *column == name);
        let place = place.ok_or_else(|| format!("the header has an unknown column `{name}`"))?;
        if columns.contains(&place) {
            return Err(format!("the header has the column `{name}` twice"));
        }
        columns.push(place);
    }
    match (0..6).find(|place| !columns.contains(place)) {
        Some(missing) => Err(format!("the header lacks the column `{}`", COLUMNS[missing])),
        None => Ok(columns),
    }
}

fn row(line: &str, columns: &[usize]) -> Result<PointLight, String> {
    let mut values = [0.0; 7];
    let mut count = 0;
    for (index, field) in line.split(',').enumerate() {
        count += 1;
        if let Some(place) = columns.get(index) {
            values[*place] = value(field.trim(), *place)?;
        }
    }
    if count != columns.len() {
        return Err(format!("the line has {count} fields, the header {}", columns.len()));
    }
    let [x, y, z, r, g, b, range] = values;
    let range = (range > 0.0).then_some(range);
    Ok(PointLight { position: Vec3::new(x, y, z), intensity: Vec3::new(r, g, b), range })
}

/// The number in column `place`; a range of 0 stands for none.
fn value(field: &str, place: usize) -> Result<f32, String> {
    let name = COLUMNS[place];
    if name == "range" && field.is_empty() {
        return Ok(0.0);
    }
    let number =
        field.parse::<f64>().map_err(|_| format!("`{name}` is \"{field}\", which is not a number"))?;
    if name == "range" && number == f64::INFINITY {
        return Ok(0.0);
    }
    if number.is_nan() || number.abs() > LARGEST {
        return Err(format!("`{name}` is {number}, which is not a finite number within ±{LARGEST:e}"));
    }
    if place >= 3 && number < 0.0 {
        return Err(format!("`{name}` is negative: {number}"));
    }
    Ok(number as f32)
}

/// `generate = { … }` of the scene file.
pub(super) struct Generator {
    pub(super) count: u32,
    pub(super) seed: u32,
    /// Corners of the box that holds the lights.
    pub(super) min: DVec3,
    /// See `min`.
    pub(super) max: DVec3,
    /// Brightest channel, W·sr⁻¹.
    pub(super) intensity: RangeInclusive<f64>,
    pub(super) range: Option<f32>,
}

impl Generator {
    /// Lights uniform in the box, of random hue.
    ///
    /// The generator is the linear congruential one of *Numerical Recipes*, s ← 1664525·s + 1013904223 mod 2³²
    /// from s = seed, and gives u = ⌊s / 256⌋ / 2²⁴ after each step. A light takes, in this order: x, z, y
    /// (min + (max − min)·u), hue (HSV with saturation 0.8 and value 1) and, only if the intensity is a range
    /// and not one number, its intensity (lo + (hi − lo)·u), which multiplies the colour.
    pub(super) fn lights(&self) -> Vec<PointLight> {
        let mut state = self.seed;
        let mut next = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        let size = self.max - self.min;
        let (low, high) = (*self.intensity.start(), *self.intensity.end());
        let light = |_| {
            let (x, z, y) = (next(), next(), next());
            let hue = next();
            let intensity = if low < high { low + (high - low) * next() } else { low };
            PointLight {
                position: (self.min + size * DVec3::new(x, y, z)).as_vec3(),
                intensity: (hsv(hue, 0.8) * intensity).as_vec3(),
                range: self.range,
            }
        };
        (0..self.count).map(light).collect()
    }
}

/// Colour of HSV value 1; `hue` in [0, 1).
fn hsv(hue: f64, saturation: f64) -> DVec3 {
    let channel = |offset: f64| {
        let distance = (hue * 6.0 + offset).rem_euclid(6.0);
        1.0 - saturation * distance.min(4.0 - distance).clamp(0.0, 1.0)
    };
    DVec3::new(channel(5.0), channel(3.0), channel(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the number of parts, every line is in one of them, and a bad one is told by its number in the file.
    #[test]
    fn parts_are_the_whole() {
        let row =
            |i: usize| if i.is_multiple_of(7) { "# é\r\n\n".into() } else { format!("{i},0,0,1,1,1\r\n") };
        let text =
            "\n# head\nx,y,z,r,g,b\n".to_owned() + &(1..400).map(row).collect::<String>() + "400,0,0,1,1,1";
        let start = text.find("1,0,0").unwrap();
        for count in [1, 2, 3, 64, 1000] {
            let parts = parts(&text, start, count);
            assert_eq!(parts.len(), count);
            assert_eq!(parts.iter().map(|part| &text[part.clone()]).collect::<String>(), text[start..]);
            assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start));
        }
        let lights = read_csv(Path::new("a.csv"), &text).unwrap();
        let wanted = (1..=400).filter(|i: &usize| *i == 400 || !i.is_multiple_of(7)).map(|i| i as f32);
        assert_eq!(
            lights.iter().map(|light| light.position.x).collect::<Vec<_>>(),
            wanted.collect::<Vec<_>>()
        );
        for bad in [1, 150, 300, 399] {
            let text = text
                .replace(&format!("\n{bad},0,0"), &format!("\n{bad},0,nan"))
                .replace("\n398,0,0", "\n398,0,?");
            let line = 1 + text.lines().position(|line| line.contains("nan") || line.contains('?')).unwrap();
            let message = read_csv(Path::new("a.csv"), &text).unwrap_err().to_string();
            assert!(message.starts_with(&format!("a.csv:{line}")), "{message}, line {line}");
        }
    }
}
