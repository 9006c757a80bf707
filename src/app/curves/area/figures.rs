//! Figures of the estimators, and which of them nothing beats.

use super::configurations::Configuration;
use super::tiers::{Family, TIERS, Tier};
use crate::app::measure::Figure;
use crate::shared::{LINEAR_GROUP, TIER_LIGHTS};
use serde::Serialize;

/// Errors are relative to the truth, or to this share of the mean truth of the cell where that is more.
pub(super) const FLOOR: f64 = 0.01;

/// One estimator on the configurations of one cell, or on all of a band.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Point {
    pub(super) band: &'static str,
    /// `all`: the mean over all models and shapes of the band.
    pub(super) model: &'static str,
    pub(super) shape: &'static str,
    pub(super) tier: &'static str,
    pub(super) family: Family,
    /// Of the light's solid angle in the hemisphere's; `null` where sizes are random.
    pub(super) share: Option<f64>,
    /// Nanoseconds per light and pixel: median, and its median absolute deviation.
    pub(super) ns: f64,
    pub(super) ns_mad: f64,
    /// Relative errors: mean and 99th percentile.
    pub(super) error: f64,
    pub(super) error_p99: f64,
    /// Sum of what is estimated over the sum of the truth, less 1.
    pub(super) bias: f64,
    /// Estimates that the errors are of.
    pub(super) count: usize,
    /// No estimator is both faster and more exact.
    pub(super) pareto: bool,
}

impl Point {
    pub(super) fn new(
        [band, model, shape]: [&'static str; 3],
        share: Option<f64>,
        tier: &Tier,
        times: &[f64],
        configurations: &[Configuration],
        values: &[f64],
    ) -> Self {
        let truth: Vec<f64> = configurations.iter().flat_map(|one| &one.truth).copied().collect();
        let floor = FLOOR * truth.iter().sum::<f64>() / truth.len() as f64;
        // Invocations of a row differ where there are random numbers.
        let invocations = if tier.family.random() { LINEAR_GROUP as usize } else { 1 };
        let lights = TIER_LIGHTS as usize;
        let (mut errors, mut sum, mut whole) = (Vec::new(), 0.0, 0.0);
        for (row, truth) in
            values.chunks_exact(LINEAR_GROUP as usize * lights).zip(truth.chunks_exact(lights))
        {
            for (value, truth) in row[..invocations * lights].iter().zip(truth.iter().cycle()) {
                errors.push((value - truth).abs() / truth.max(floor));
                sum += value - truth;
                whole += truth;
            }
        }
        errors.sort_by(f64::total_cmp);
        let time = Figure::of(times).unwrap_or_default();
        Self {
            band,
            model,
            shape,
            tier: tier.name,
            family: tier.family,
            share,
            ns: time.median,
            ns_mad: time.mad,
            error: errors.iter().sum::<f64>() / errors.len() as f64,
            error_p99: errors[(errors.len() * 99) / 100],
            bias: sum / whole,
            count: errors.len(),
            pareto: false,
        }
    }

    pub(super) fn summary(&self) -> bool {
        self.model == "all"
    }
}

/// Adds the mean over models and shapes for each band and tier, and finds the Pareto front of each group.
pub(super) fn complete(mut points: Vec<Point>, bands: impl IntoIterator<Item = &'static str>) -> Vec<Point> {
    for band in bands {
        for tier in TIERS.iter().filter(|tier| tier.family != Family::None) {
            let group: Vec<_> = points.iter().filter(|p| p.band == band && p.tier == tier.name).collect();
            let mean = |value: &dyn Fn(&Point) -> f64| {
                group.iter().map(|point| value(point)).sum::<f64>() / group.len() as f64
            };
            let point = Point {
                band,
                model: "all",
                shape: "all",
                tier: tier.name,
                family: tier.family,
                share: None,
                ns: mean(&|p| p.ns),
                ns_mad: mean(&|p| p.ns_mad),
                error: mean(&|p| p.error),
                error_p99: mean(&|p| p.error_p99),
                bias: mean(&|p| p.bias),
                count: group.iter().map(|p| p.count).sum(),
                pareto: false,
            };
            points.push(point);
        }
    }
    front(&mut points);
    points
}

/// Marks what nothing of the same cell beats.
pub(super) fn front(points: &mut [Point]) {
    let cell = |p: &Point| (p.band, p.model, p.shape, p.share.map(f64::to_bits));
    let same = |a: &Point, b: &Point| cell(a) == cell(b);
    let beaten = |p: &Point| points.iter().any(|q| same(p, q) && q.ns < p.ns && q.error <= p.error);
    let front: Vec<bool> = points.iter().map(|p| !beaten(p)).collect();
    for (point, pareto) in points.iter_mut().zip(front) {
        point.pareto = pareto;
    }
}
