//! A layer's texels together: each is fitted from the analytic limit and from its neighbours, then the table is smoothed.

use rayon::prelude::*;

use super::fit::{Fit, Point};
use super::matrix::Shape;
use super::minimize::minimize;
use super::{Layer, Objective};

/// Rounds in which every texel starts from its neighbours; the gain of later ones is below 1e-4.
const ROUNDS: usize = 4;
/// Rounds that trade a little loss for neighbours that agree.
const SMOOTHING: usize = 4;
/// How much loss a texel may pay for that, over the least that was found.
const PRICE: f64 = 1.01;
/// Starts of the first round, as ln(d/d₀) and c/d: the analytic limit, and a lobe that is wide or leans up.
const STARTS: [Point; 3] = [[0.0; 4], [0.0, 0.0, 1.0, 0.5], [0.5, -0.5, 1.0, 0.0]];

/// Least losses and their points, in the order of the table.
type Found = Vec<(f64, Point)>;

/// The shapes of `layer`'s texels, row by row; `done` is called after each of [`work`] steps.
pub(super) fn fit(layer: Layer, objective: Objective, done: &(impl Fn() + Sync)) -> Vec<Shape> {
    let count = texels(layer);
    let each = |step: &(dyn Fn(usize, &Fit) -> (f64, Point) + Sync)| -> Found {
        let fitted = (0..count).into_par_iter().map(|index| {
            let found = step(index, &texel(layer, objective, index));
            done();
            found
        });
        fitted.collect()
    };
    let mut found = if layer == Layer::Clearcoat {
        follow(layer, objective, done)
    } else {
        let mut found = each(&|_, fit| best(STARTS.map(|start| fit.descend(start)).into_iter()));
        for _ in 0..ROUNDS {
            found = each(&|index, fit| {
                let starts = neighbours(layer, index).map(|other| fit.descend(found[other].1));
                best(std::iter::once(found[index]).chain(starts))
            });
        }
        found
    };
    let least: Vec<f64> = found.iter().map(|(loss, _)| *loss).collect();
    for _ in 0..SMOOTHING {
        found = each(&|index, fit| {
            let mean = mean(&found, layer, index);
            let towards = |share: f64| -> Point {
                let own = found[index].1;
                std::array::from_fn(|i| own[i] + share * (mean[i] - own[i]))
            };
            let descended = fit.descend(mean);
            let tries = [1.0, 0.5, 0.25].map(towards).map(|point| (fit.loss(&point).0, point));
            let fits = |&(loss, _): &(f64, Point)| loss <= PRICE * least[index];
            tries.into_iter().find(fits).or(Some(descended).filter(fits)).unwrap_or(found[index])
        });
    }
    let shapes = found.iter().enumerate();
    let mut shapes: Vec<_> =
        shapes.map(|(index, (_, point))| texel(layer, objective, index).shape(point)).collect();
    mend_last_row(layer, objective, &mut shapes);
    shapes
}

/// Row by row from normal incidence, each texel from the one above alone: where a lobe has two minima that change places,
/// the table stays in one, for between two texels of different kinds neither would be right.
fn follow(layer: Layer, objective: Objective, done: &(impl Fn() + Sync)) -> Found {
    let [columns, rows] = layer.size();
    let mut found: Found = vec![(0.0, [0.0; 4]); columns];
    for row in 0..rows {
        let before = &found[found.len() - columns..];
        let fitted = (0..columns).into_par_iter().map(|column| {
            let found = texel(layer, objective, row * columns + column).descend(before[column].1);
            (0..=ROUNDS).for_each(|_| done());
            found
        });
        let fitted: Found = fitted.collect();
        found.extend(fitted);
    }
    found.split_off(columns)
}

/// No surface is seen at exactly 90°, and near there lobes change faster than a row: the last row is chosen so that the
/// last cells come out right.
fn mend_last_row(layer: Layer, objective: Objective, shapes: &mut [Shape]) {
    let [columns, rows] = layer.size();
    let (head, last) = shapes.split_at_mut(columns * (rows - 1));
    let before = &head[columns * (rows - 2)..];
    last.par_iter_mut().enumerate().for_each(|(column, shape)| {
        let at = |share: f64| {
            let parameters = layer.parameters(column as f64, rows as f64 - 2.0 + share);
            (share, Fit::new(layer, parameters, objective))
        };
        let places = [0.25, 0.5, 0.75, 0.9].map(at);
        let end = &places[3].1;
        let loss = |point: &Point| {
            let own = end.shape(point);
            let (mut sum, mut slopes) = (0.0, [0.0; 4]);
            for (share, fit) in &places {
                let between = std::array::from_fn(|i| before[column][i] * (1.0 - share) + own[i] * share);
                let (value, along) = fit.loss_of(between);
                sum += value;
                slopes = std::array::from_fn(|i| slopes[i] + share * along[i]);
            }
            (sum, end.chain(own, slopes))
        };
        let starts = [*shape, before[column], std::array::from_fn(|i| 0.5 * (shape[i] + before[column][i]))];
        let (_, found) = best(starts.map(|start| minimize(loss, end.point(start))).into_iter());
        *shape = end.shape(&found);
    });
}

/// How often [`fit`] calls `done`.
pub(super) fn work(layer: Layer) -> u64 {
    (texels(layer) * (1 + ROUNDS + SMOOTHING)) as u64
}

pub(super) fn texels(layer: Layer) -> usize {
    layer.size().iter().product()
}

fn texel(layer: Layer, objective: Objective, index: usize) -> Fit {
    let columns = layer.size()[0];
    let parameters = layer.parameters((index % columns) as f64, (index / columns) as f64);
    Fit::new(layer, parameters, objective)
}

fn best(found: impl Iterator<Item = (f64, Point)>) -> (f64, Point) {
    let least = found.reduce(|best, new| if new.0 < best.0 { new } else { best });
    least.unwrap_or((f64::INFINITY, [0.0; 4]))
}

/// Indices of the up to four texels beside `index`.
fn neighbours(layer: Layer, index: usize) -> impl Iterator<Item = usize> {
    let [columns, rows] = layer.size();
    let (column, row) = (index % columns, index / columns);
    let beside = [
        (column > 0).then(|| index - 1),
        (column + 1 < columns).then(|| index + 1),
        (row > 0).then(|| index - columns),
        (row + 1 < rows).then(|| index + columns),
    ];
    beside.into_iter().flatten()
}

/// The mean of the neighbours, opposite ones only, so that a slope is left as it is.
fn mean(found: &Found, layer: Layer, index: usize) -> Point {
    let [columns, rows] = layer.size();
    let (column, row) = (index % columns, index / columns);
    let mut pairs = Vec::new();
    if column > 0 && column + 1 < columns {
        pairs.extend([index - 1, index + 1]);
    }
    if row > 0 && row + 1 < rows {
        pairs.extend([index - columns, index + columns]);
    }
    if pairs.is_empty() {
        return found[index].1;
    }
    std::array::from_fn(|i| pairs.iter().map(|&other| found[other].1[i]).sum::<f64>() / pairs.len() as f64)
}
