//! A layer's table from beginning to end, with the figures that judge it.

use rayon::prelude::*;

use super::assess::{Assessment, assess_over};
use super::fit::Fit;
use super::lobe::mix;
use super::samples::Samples;
use super::{Basis, Frame, Layer, LayerTable, Lobe, Objective, Parameters, Shape, Tables, grid};

/// Directions that judge a table; not those of the fits.
const SAMPLES: usize = 20_000;
/// What the judging directions and the places between the judged ones may miss of a bound: a share of it, and this much.
const MARGIN: [f64; 2] = [1.02, 2e-4];

/// The figures of a place in a table: of a texel, or of the middle of an edge or of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// In texels.
    pub column: f64,
    /// In texels.
    pub row: f64,
    /// Where that is.
    pub parameters: Parameters,
    /// The lobe's own albedo.
    pub albedo: f64,
    /// What the interpolated table makes of the lobe.
    pub table: Assessment,
    /// Total variation of a fit made for this very place; at texels none is made anew, and it is the table's.
    pub fitted: f64,
}

/// A table and its figures, at every half texel, row by row.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The table.
    pub table: LayerTable,
    /// (2 columns − 1) × (2 rows − 1) figures.
    pub cells: Vec<Cell>,
}

/// Fits, integrates and judges `layer`; calls `done` after each of [`fit_work`] steps.
#[must_use]
pub fn fit_layer(layer: Layer, objective: Objective, done: &(impl Fn() + Sync)) -> Fitted {
    let mut table = LayerTable::new(layer, &grid::fit(layer, objective, done));
    let [columns, rows] = layer.size();
    let (wide, high) = (2 * columns - 1, 2 * rows - 1);
    let place = |index: usize| [(index % wide) as f64 * 0.5, (index / wide) as f64 * 0.5];
    let moments: Vec<[f64; 3]> = (0..wide * high)
        .into_par_iter()
        .map(|index| {
            let [column, row] = place(index);
            let moments = Lobe::new(layer, layer.parameters(column, row)).moments();
            done();
            moments
        })
        .collect();
    let last = columns * (rows - 1);
    for (index, stored) in table.moments.iter_mut().enumerate() {
        let at = |half_rows: usize| moments[(index / columns * 2 - half_rows) * wide + index % columns * 2];
        // As the shapes of the last row: what makes the middle of the last cell right.
        let mended = || std::array::from_fn(|i| (2.0 * at(1)[i] - at(2)[i]).max(0.0));
        let [a, b, c]: [f64; 3] = if index < last { at(0) } else { mended() };
        *stored = [a as f32, b as f32, c as f32, 0.0];
    }
    let judged = |index: usize| {
        let [column, row] = place(index);
        let cell = judge(&table, objective, column, row, mix(layer, moments[index]));
        done();
        cell
    };
    let cells: Vec<Cell> = (0..wide * high).into_par_iter().map(judged).collect();
    bound(&mut table, &cells);
    Fitted { table, cells }
}

/// Stores of each texel the largest bound around it; in the last row, what makes the interpolated bounds hold up to 90°.
fn bound(table: &mut LayerTable, cells: &[Cell]) {
    let [columns, rows] = table.layer.size();
    let wide = 2 * columns - 1;
    let around = |at: usize, end: usize| at.saturating_sub(2)..(at + 3).min(end);
    let largest = |column: usize, rows: std::ops::Range<usize>| {
        let indices = rows.flat_map(|y| around(2 * column, wide).map(move |x| y * wide + x));
        with_margin(indices.map(|index| cells[index].table.bound))
    };
    for index in 0..columns * (rows - 1) {
        let (column, row) = (index % columns, index / columns);
        table.moments[index][3] = largest(column, around(2 * row, 2 * rows - 2)) as f32;
    }
    let last: Vec<f32> = (0..columns)
        .into_par_iter()
        .map(|column| {
            let before = f64::from(table.moments[columns * (rows - 2) + column][3]);
            let near = [0.75, 0.9].map(|share| {
                let sides = around(2 * column, wide).map(|x| {
                    let place = table.layer.parameters(0.5 * x as f64, rows as f64 - 2.0 + share);
                    let lobe = Lobe::new(table.layer, place);
                    against(table, place, &judges(&lobe), lobe.albedo()).bound
                });
                (with_margin(sides) - before * (1.0 - share)) / share
            });
            near.into_iter().fold(largest(column, 2 * rows - 2..2 * rows - 1), f64::max) as f32
        })
        .collect();
    for (column, bound) in last.into_iter().enumerate() {
        table.moments[columns * (rows - 1) + column][3] = bound;
    }
}

/// The largest of `bounds`, and a little more.
fn with_margin(bounds: impl Iterator<Item = f64>) -> f64 {
    MARGIN[0] * bounds.fold(0.0, f64::max) + MARGIN[1]
}

/// How often [`fit_layer`] calls `done`.
#[must_use]
pub fn fit_work(layer: Layer) -> u64 {
    let [columns, rows] = layer.size();
    grid::work(layer) + 2 * ((2 * columns - 1) * (2 * rows - 1)) as u64
}

/// All layers' tables as one; in the order of [`Layer::ALL`].
#[must_use]
pub fn join(layers: Vec<LayerTable>) -> Tables {
    Tables::new(layers)
}

/// The shape that fits `layer` at `parameters`, started from `near` and from the analytic limit.
#[must_use]
pub fn fit_texel(layer: Layer, parameters: Parameters, objective: Objective, near: Option<Shape>) -> Shape {
    let fit = Fit::new(layer, parameters, objective);
    let limit = fit.descend([0.0; 4]);
    let found = match near.map(|near| fit.descend(fit.point(near))) {
        Some(found) if found.0 < limit.0 => found,
        _ => limit,
    };
    fit.shape(&found.1)
}

fn judge(table: &LayerTable, objective: Objective, column: f64, row: f64, albedo: f64) -> Cell {
    let layer = table.layer;
    let parameters = layer.parameters(column, row);
    let lobe = Lobe::new(layer, parameters);
    let samples = judges(&lobe);
    let assessed = against(table, parameters, &samples, albedo);
    let fitted = if column.fract() == 0.0 && row.fract() == 0.0 {
        assessed.variation
    } else {
        let near = table.shape_at(parameters);
        let shape = fit_texel(layer, parameters, objective, Some(near));
        let inverse = Basis::new(table.frame, &lobe).inverse(shape);
        assess_over(&samples, albedo, &inverse, albedo).variation
    };
    Cell { column, row, parameters, albedo, table: assessed, fitted }
}

fn judges(lobe: &Lobe) -> Samples {
    Samples::new(lobe, &Basis::new(Frame::Normal, lobe), SAMPLES)
}

/// What the interpolated table makes of the lobe at `parameters`.
fn against(table: &LayerTable, parameters: Parameters, samples: &Samples, albedo: f64) -> Assessment {
    let lookup = table.lookup(parameters);
    // This layer's albedo is known in closed form, 1 − (1 − n·wo/2)⁵, and vanishes at 90°, where no table is right.
    let mass = if table.layer == Layer::SubstrateDiffuse { albedo } else { lookup.mass() };
    assess_over(samples, albedo, &lookup.inverse, mass)
}
