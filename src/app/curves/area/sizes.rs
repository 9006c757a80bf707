//! Estimators by the light's size: tables and a plot.

use super::super::plot::{Drawn, Label, Plot, chart, draw_labels, ranges, within};
use super::configurations::BANDS;
use super::figures::Point;
use super::plot::FAMILIES;
use super::tiers::{Family, TIERS};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::fmt::Write as _;

/// What ships, to which samples are given as much time.
const SHIPPED: &str = "amas, error .01";
/// Of errors.
const LEAST: f64 = 1e-7;
const AXES: &str = "across: the light's share of the hemisphere; up: mean relative error";

/// Of a band, by size.
fn of<'a>(points: &'a [Point], band: &'a str, tier: &'a str) -> impl Iterator<Item = &'a Point> + Clone {
    points.iter().filter(move |p| p.band == band && p.tier == tier)
}

/// Error of as many samples of a family as take the time of `like`: the inverse root of their number from those that come
/// nearest to it; `None` where that is not one.
fn at_equal_time(points: &[Point], like: &Point, family: Family) -> Option<f64> {
    let same = |p: &&Point| p.family == family && p.band == like.band && p.share == like.share;
    // Differences of times: on a busy machine, of the shortest nothing is left.
    let own = points.iter().filter(same).filter(|p| p.ns > 0.0 && like.ns > 0.0);
    let apart = |p: &&Point| (p.ns / like.ns).ln().abs();
    let nearest = own.min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let count = TIERS.iter().find(|tier| tier.name == nearest.tier)?.points;
    (f64::from(count) * like.ns >= nearest.ns).then(|| nearest.error * (nearest.ns / like.ns).sqrt())
}

/// The page's section.
pub(super) fn section(text: &mut String, points: &[Point]) {
    text.push_str(
        "\n## By the light's size\n\n\
         ![Mean relative error over the light's share of the hemisphere](sizes.png)\n\n\
         Squares at distance 1 that face the point, on plastic; else as above. A light's size is its solid angle over that of \
         the hemisphere. Each cell: mean error, and ns per light and pixel; the Pareto front in bold. The last rows are random \
         samples with as much time as *amas, error .01* takes at that size, from those that were measured by the inverse root \
         of their number.\n",
    );
    BANDS.iter().for_each(|(band, _)| table(text, points, band));
}

fn table(text: &mut String, points: &[Point], band: &str) {
    let shares = of(points, band, SHIPPED).map(|p| format!(" {} |", p.share.unwrap_or_default()));
    let rules: String = of(points, band, SHIPPED).map(|_| " --- |").collect();
    // Writing to a string cannot fail.
    let _ = write!(text, "\n{band}:\n\n| estimator |{}\n| --- |{rules}\n", shares.collect::<String>());
    for tier in TIERS.iter().filter(|tier| tier.family != Family::None) {
        let cell = |p: &Point| {
            let bold = if p.pareto { "**" } else { "" };
            format!(" {bold}{:.3} %{bold}, {:.0} |", 100.0 * p.error, p.ns)
        };
        let _ =
            writeln!(text, "| {} |{}", tier.name, of(points, band, tier.name).map(cell).collect::<String>());
    }
    for (name, family) in [("area samples", Family::AreaSamples), ("LTC samples", Family::ProxySamples)] {
        let error = |p: &Point| match at_equal_time(points, p, family) {
            Some(error) => format!(" {:.3} %, {:.0} |", 100.0 * error, p.ns),
            None => " – |".into(),
        };
        let cells: String = of(points, band, SHIPPED).map(error).collect();
        let _ = writeln!(text, "| {name} in the time of amas |{cells}");
    }
}

/// The plot of a set of points.
pub(super) struct SizesPlot<'a>(pub(super) &'a [Point]);

impl Plot for SizesPlot<'_> {
    const SIZE: (u32, u32) = (1560, 800);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        let mut labels = Vec::new();
        for ((band, _), panel) in BANDS.into_iter().zip(root.split_evenly((1, BANDS.len()))) {
            labels.extend(draw_panel(&panel, self.0, band)?);
        }
        draw_labels(root, &labels)?;
        root.present()
    }
}

/// A line a tier, samples by what they do in the time of [`SHIPPED`]; labels at the last points.
fn draw_panel<B: DrawingBackend>(
    panel: &DrawingArea<B, Shift>,
    points: &[Point],
    band: &str,
) -> Result<Vec<Label>, DrawingAreaErrorKind<B::ErrorType>> {
    let mut lines = Vec::new();
    for tier in TIERS.iter().filter(|tier| tier.family != Family::None && !tier.family.random()) {
        lines.push((tier.name, tier.family, places(of(points, band, tier.name), |p| Some(p.error))));
    }
    for (name, family) in
        [("area samples, equal time", Family::AreaSamples), ("LTC samples, equal time", Family::ProxySamples)]
    {
        let error = |p: &Point| at_equal_time(points, p, family);
        lines.push((name, family, places(of(points, band, SHIPPED), error)));
    }
    let [share, error] = ranges(lines.iter().flat_map(|(_, _, line)| line.iter().copied()), LEAST);
    // Room for the labels.
    let mut chart = chart(panel, band, [share.start..30.0 * share.end, error], AXES)?;
    let within = within(panel);
    let mut labels = Vec::new();
    for (name, family, line) in lines {
        let color = FAMILIES.iter().find(|row| row.0 == family).map_or(BLACK, |row| row.1);
        let width = if family == Family::Shipped { 3 } else { 1 };
        chart.draw_series([PathElement::new(line.clone(), color.stroke_width(width))])?;
        chart.draw_series(line.iter().map(|&at| Circle::new(at, 3, color.filled())))?;
        if let Some(last) = line.last() {
            let at = chart.plotting_area().map_coordinate(last);
            labels.push(Label { at, text: name.to_owned(), color, within });
        }
    }
    Ok(labels)
}

/// Shares and errors.
fn places<'a>(
    points: impl Iterator<Item = &'a Point>,
    error: impl Fn(&Point) -> Option<f64>,
) -> Vec<(f64, f64)> {
    points.filter_map(|p| Some((p.share?, error(p)?.max(LEAST)))).collect()
}
