//! Figures of each way to gather light, and which of them nothing beats.

use crate::app::args::INDIRECT_ERROR;
use crate::app::measure::Figure;
use serde::Serialize;

/// A way to find light that comes by way of other surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Family {
    /// What `amas render` does.
    Gathered,
    /// Paths from the eye, the oracle's.
    Paths,
    /// Every virtual light at every pixel, the geometry term as it is.
    Plain,
    /// The same, the geometry term clamped.
    Clamped,
}

impl Family {
    /// As the pages call it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Gathered => "amas",
            Self::Paths => "paths",
            Self::Plain => "plain VPLs",
            Self::Clamped => "plain VPLs, clamped",
        }
    }
}

/// One picture of one repetition.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) family: Family,
    /// Virtual lights, of a round where there are rounds; paths of a pixel.
    pub(super) count: u32,
    /// 1 where there are none.
    pub(super) rounds: u32,
    pub(super) cpu_s: f64,
    pub(super) wall_s: f64,
    /// Mean square error over the square of the picture's mean, without the truth's own.
    pub(super) square: f64,
    /// Mean over that of the truth, less 1.
    pub(super) bias: f64,
    /// What `error_estimate.indirect_relative` says.
    pub(super) estimate: Option<f64>,
}

/// All repetitions of one.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Point {
    pub(super) family: Family,
    pub(super) count: u32,
    pub(super) rounds: u32,
    /// CPU time of the process, seconds.
    pub(super) cpu_s: Figure,
    pub(super) wall_s: Figure,
    /// Root mean square error over the picture's mean.
    pub(super) error: f64,
    pub(super) bias: f64,
    /// Root of the mean square of the program's own estimates; `null` before two rounds, and of what estimates nothing.
    pub(super) estimate: Option<f64>,
    /// Nothing is both faster and more exact.
    pub(super) pareto: bool,
    /// Where `amas render` stops by default.
    pub(super) default: bool,
}

impl Point {
    fn of(samples: &[&Sample]) -> Self {
        let mean = |value: &dyn Fn(&Sample) -> f64| {
            samples.iter().map(|sample| value(sample)).sum::<f64>() / samples.len() as f64
        };
        let figure = |value: fn(&&&Sample) -> f64| {
            Figure::of(&samples.iter().map(|sample| value(&sample)).collect::<Vec<_>>()).unwrap_or_default()
        };
        let first = samples[0];
        Self {
            family: first.family,
            count: first.count,
            rounds: first.rounds,
            cpu_s: figure(|sample| sample.cpu_s),
            wall_s: figure(|sample| sample.wall_s),
            error: mean(&|sample| sample.square).max(0.0).sqrt(),
            bias: mean(&|sample| sample.bias),
            estimate: first.estimate.map(|_| mean(&|sample| sample.estimate.unwrap_or(0.0).powi(2)).sqrt()),
            pareto: false,
            default: false,
        }
    }

    /// Of the same curve.
    pub(super) fn along(&self, other: &Self) -> bool {
        self.family == other.family && (self.family != Family::Gathered || self.count == other.count)
    }
}

/// A point for each that was repeated, in the order of their first samples; `vpls` are the scene's own.
pub(super) fn points(samples: &[Sample], vpls: u32) -> Vec<Point> {
    let key = |sample: &Sample| (sample.family, sample.count, sample.rounds);
    let mut keys: Vec<_> = Vec::new();
    samples.iter().map(key).for_each(|key| {
        if !keys.contains(&key) {
            keys.push(key);
        }
    });
    let of = |wanted| Point::of(&samples.iter().filter(|sample| key(sample) == wanted).collect::<Vec<_>>());
    let mut points: Vec<Point> = keys.into_iter().map(of).collect();
    let beaten = |p: &Point| points.iter().any(|q| q.cpu_s.median < p.cpu_s.median && q.error <= p.error);
    let front: Vec<bool> = points.iter().map(|p| !beaten(p)).collect();
    points.iter_mut().zip(front).for_each(|(point, pareto)| point.pareto = pareto);
    let good_enough = |p: &&mut Point| {
        p.family == Family::Gathered && p.count == vpls && p.estimate.is_some_and(|e| e <= INDIRECT_ERROR)
    };
    points.iter_mut().find(good_enough).into_iter().for_each(|point| point.default = true);
    points
}

/// Error of paths after so many CPU seconds, by the law that it falls with their root; `None` without paths.
pub(super) fn paths_after(points: &[Point], cpu_s: f64) -> Option<f64> {
    let most = points.iter().rfind(|p| p.family == Family::Paths)?;
    Some(most.error * (most.cpu_s.median / cpu_s).sqrt())
}
