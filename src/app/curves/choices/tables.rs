//! Tables of transformed cosines with fewer texels and fewer bits, against the lobes.

use crate::error::Result;
use crate::ltc::{
    Basis, Layer, LayerTable, Lobe, Lookup, Objective, Parameters, Shape, assess, fit_texel, tables,
};
use crate::reference::sampler::Random;
use half::f16;
use rayon::prelude::*;
use serde::Serialize;

/// Most of √(1 − n·wo): 88°, beyond which the last row is no fit.
const STEEPEST: f64 = 0.98;
/// A mirror's direction is a limit of its own.
const SMOOTHEST: f64 = 0.05;
const LAYERS: [Layer; 2] = [Layer::Metal, Layer::Plastic];

/// How a number of a table is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Format {
    Float,
    Half,
    Snorm16,
    Snorm8,
}

impl Format {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Half => "half",
            Self::Snorm16 => "16 bits, fixed",
            Self::Snorm8 => "8 bits, fixed",
        }
    }

    fn bytes(self) -> usize {
        match self {
            Self::Float => 4,
            Self::Half | Self::Snorm16 => 2,
            Self::Snorm8 => 1,
        }
    }

    /// What is left of a number, of those up to `most`.
    fn round(self, value: f64, most: f64) -> f64 {
        let fixed = |codes: f64| (value / most * codes).round() / codes * most;
        match self {
            Self::Float => f64::from(value as f32),
            Self::Half => f16::from_f64(value).to_f64(),
            Self::Snorm16 => fixed(32_767.0),
            Self::Snorm8 => fixed(127.0),
        }
    }
}

/// A table, and how far it is from its lobe: errors of ∫ D over any directions, over the lobe's albedo.
#[derive(Serialize)]
pub(super) struct Stored {
    pub(super) layer: &'static str,
    /// Texels along each side; `null`: a fit for each place.
    pub(super) side: Option<u32>,
    pub(super) format: Format,
    /// Of matrices and moments together.
    pub(super) bytes: Option<usize>,
    pub(super) mean: f64,
    pub(super) worst: f64,
    /// As it ships, on the device.
    pub(super) default: bool,
}

/// Sides and formats, the last as it ships: files have 16 bits, of which the device makes floats.
const KINDS: [(u32, Format); 7] = [
    (4, Format::Float),
    (8, Format::Float),
    (16, Format::Float),
    (32, Format::Snorm8),
    (32, Format::Half),
    (32, Format::Snorm16),
    (32, Format::Float),
];

/// At so many places of each layer.
pub(super) fn measure(places: usize) -> Result<Vec<Stored>> {
    let mut all = Vec::new();
    for layer in LAYERS {
        let table = tables()?.layer(layer);
        let mut random = Random::new(layer as u64);
        let at = (0..places).map(|_| {
            let [first, last] = layer.axis();
            let r = first + (last - first) * (SMOOTHEST + (1.0 - SMOOTHEST) * random.next());
            Parameters { r, cos: 1.0 - (STEEPEST * random.next()).powi(2) }
        });
        let at: Vec<Parameters> = at.collect();
        all.push(own_fits(table, &at));
        all.extend(KINDS.map(|(side, format)| Coarse::new(table, side, format).judge(&at)));
    }
    Ok(all)
}

/// A fit for each place: what no table can beat.
fn own_fits(table: &LayerTable, places: &[Parameters]) -> Stored {
    let error = |&place: &Parameters| {
        let lobe = Lobe::new(table.layer, place);
        let shape = fit_texel(table.layer, place, Objective::L1, Some(table.shape_at(place)));
        assess(&lobe, &Basis::new(table.frame, &lobe).inverse(shape), lobe.albedo()).bound
    };
    let errors: Vec<f64> = places.par_iter().map(error).collect();
    stored(table.layer, (None, Format::Float), &errors)
}

fn stored(layer: Layer, (side, format): (Option<u32>, Format), errors: &[f64]) -> Stored {
    Stored {
        layer: layer.name(),
        side,
        format,
        bytes: side.map(|side| 8 * format.bytes() * (side * side) as usize),
        mean: errors.iter().sum::<f64>() / errors.len() as f64,
        worst: errors.iter().copied().fold(0.0, f64::max),
        default: (side, format) == (Some(32), Format::Float),
    }
}

/// A square table of the same extent as the one that ships, which it takes its texels from.
struct Coarse<'a> {
    of: &'a LayerTable,
    side: u32,
    format: Format,
    /// Matrix and moments of each texel.
    texels: Vec<[Shape; 2]>,
}

impl<'a> Coarse<'a> {
    fn new(of: &'a LayerTable, side: u32, format: Format) -> Self {
        let [columns, rows] = of.layer.size().map(|side| (side - 1) as f64);
        let step = f64::from(side - 1);
        let scale = f64::from(of.scale);
        let texel = |index: u32| {
            let [column, row] = [index % side, index / side].map(f64::from);
            let place = of.layer.parameters(column / step * columns, row / step * rows);
            let Lookup { moments, .. } = of.lookup(place);
            [of.shape_at(place).map(|v| format.round(v, scale)), moments.map(|v| format.round(v, 1.0))]
        };
        Self { of, side, format, texels: (0..side * side).map(texel).collect() }
    }

    fn judge(&self, places: &[Parameters]) -> Stored {
        let error = |&place: &Parameters| {
            let lobe = Lobe::new(self.of.layer, place);
            let [shape, moments] = self.at(place);
            let inverse = Basis::new(self.of.frame, &lobe).inverse(shape);
            let lookup = Lookup { layer: self.of.layer, inverse, moments };
            assess(&lobe, &inverse, lookup.mass()).bound
        };
        let errors: Vec<f64> = places.par_iter().map(error).collect();
        stored(self.of.layer, (Some(self.side), self.format), &errors)
    }

    /// Bilinearly.
    fn at(&self, place: Parameters) -> [Shape; 2] {
        let [columns, rows] = self.of.layer.size().map(|side| (side - 1) as f64);
        let [column, row] = self.of.layer.texel(place);
        let step = f64::from(self.side - 1);
        let [x, y] = [column / columns * step, row / rows * step];
        let [left, top] = [x, y].map(|at| at.floor().min(step - 1.0));
        let texel = |dx: f64, dy: f64| {
            let weight = [x - left, y - top];
            let share = |d: f64, w: f64| if d > 0.0 { w } else { 1.0 - w };
            let index = (top + dy) as usize * self.side as usize + (left + dx) as usize;
            (share(dx, weight[0]) * share(dy, weight[1]), self.texels[index])
        };
        let mut sum = [[0.0; 4]; 2];
        for (weight, texel) in [texel(0.0, 0.0), texel(1.0, 0.0), texel(0.0, 1.0), texel(1.0, 1.0)] {
            for (sum, value) in sum.as_flattened_mut().iter_mut().zip(texel.as_flattened()) {
                *sum += weight * value;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With as many texels as the table itself, all of its numbers.
    #[test]
    fn the_same_size_is_the_same_table() {
        for layer in LAYERS {
            let table = tables().unwrap().layer(layer);
            let coarse = Coarse::new(table, 32, Format::Snorm16);
            for (r, cos) in [(0.3, 0.7), (0.51, 0.2), (1.0, 1.0), (0.0, 0.05)] {
                let place = Parameters { r, cos };
                let (got, want) = (coarse.at(place), table.shape_at(place));
                for (got, want) in got[0].iter().zip(want) {
                    assert!((got - want).abs() < 1e-6, "{layer:?} {r} {cos}: {got} for {want}");
                }
            }
        }
    }
}
