//! The plot: error over time for the two knobs, time over the number of lights; all logarithmic. The order of the lights and
//! the shape of clusters have no error to plot.

use super::super::plot::{Drawn, Label, Plot, chart, draw_labels, ranges, within};
use super::Point;
use super::sweeps::{GROWTH, SWEEPS};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The plot of a set of points.
pub(super) struct LightsPlot<'a>(pub(super) &'a [Point]);

const LINE: RGBColor = RGBColor(30, 90, 200);
const SAMPLED: RGBColor = RGBColor(200, 30, 30);
/// Errors below this are rounding.
const LEAST_ERROR: f64 = 1e-7;

impl Plot for LightsPlot<'_> {
    const SIZE: (u32, u32) = (1560, 560);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        let plotted: Vec<_> = SWEEPS.iter().filter(|sweep| sweep.is_plotted()).collect();
        let mut labels = Vec::new();
        for (sweep, panel) in plotted.iter().zip(root.split_evenly((1, plotted.len()))) {
            let own: Vec<&Point> = self.0.iter().filter(|p| p.sweep == sweep.name).collect();
            let growth = sweep.name == GROWTH;
            let at = |p: &Point| match growth {
                true => (p.setting, p.cpu_ms.median),
                false => (p.cpu_ms.median, p.error.max(LEAST_ERROR)),
            };
            let axes = if growth {
                "across: lights; up: CPU ms"
            } else {
                "across: CPU ms; up: mean relative error; ringed: the default"
            };
            let places: Vec<_> = own.iter().map(|p| (at(p), *p)).collect();
            labels.extend(draw_panel(&panel, sweep.what, axes, &places)?);
        }
        draw_labels(root, &labels)?;
        root.present()
    }
}

/// Points of the knob and of random sampling, each kind joined by a line, and each one's label. What ships has a ring.
fn draw_panel<B: DrawingBackend>(
    panel: &DrawingArea<B, Shift>,
    title: &str,
    axes: &str,
    places: &[((f64, f64), &Point)],
) -> Result<Vec<Label>, DrawingAreaErrorKind<B::ErrorType>> {
    let ranges = ranges(places.iter().map(|(at, _)| *at), LEAST_ERROR);
    let mut chart = chart(panel, title, ranges, axes)?;
    for (sampled, color) in [(false, LINE), (true, SAMPLED)] {
        let own = || places.iter().filter(move |(_, p)| p.sampled == sampled);
        chart.draw_series([PathElement::new(
            own().map(|(at, _)| *at).collect::<Vec<_>>(),
            color.stroke_width(1),
        )])?;
        chart.draw_series(own().map(|(at, _)| Circle::new(*at, 4, color.filled())))?;
        let default = own().filter(|(_, p)| p.default);
        chart.draw_series(default.map(|(at, _)| Circle::new(*at, 9, color.stroke_width(2))))?;
    }
    let within = within(panel);
    let label = |(at, p): &((f64, f64), &Point)| Label {
        at: chart.plotting_area().map_coordinate(at),
        text: p.label.clone(),
        color: if p.sampled { SAMPLED } else { BLACK },
        within,
    };
    Ok(places.iter().map(label).collect())
}
