//! The plot: error over time for the two knobs, time over the number of lights; all logarithmic.

use super::super::plot::{Drawn, FONT, Plot, chart, ranges};
use super::Point;
use super::sweeps::{GROWTH, SWEEPS};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The plot of a set of points.
pub(super) struct LightsPlot<'a>(pub(super) &'a [Point]);

const LINE: RGBColor = RGBColor(30, 90, 200);
/// Errors below this are rounding.
const LEAST_ERROR: f64 = 1e-7;

impl Plot for LightsPlot<'_> {
    const SIZE: (u32, u32) = (1560, 560);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        for (sweep, panel) in SWEEPS.iter().zip(root.split_evenly((1, SWEEPS.len()))) {
            let own: Vec<&Point> = self.0.iter().filter(|p| p.sweep == sweep.name).collect();
            let growth = sweep.name == GROWTH;
            let at = |p: &Point| match growth {
                true => (p.setting, p.cpu_ms.median),
                false => (p.cpu_ms.median, p.error.max(LEAST_ERROR)),
            };
            let axes =
                if growth { "across: lights; up: CPU ms" } else { "across: CPU ms; up: mean relative error" };
            draw_panel(
                &panel,
                sweep.what,
                axes,
                &own.iter().map(|p| (at(p), p.setting)).collect::<Vec<_>>(),
            )?;
        }
        root.present()
    }
}

/// Points joined by a line, each labelled with its setting.
fn draw_panel<B: DrawingBackend>(
    panel: &DrawingArea<B, Shift>,
    title: &str,
    axes: &str,
    points: &[((f64, f64), f64)],
) -> Drawn<B> {
    let ranges = ranges(points.iter().map(|(at, _)| *at), LEAST_ERROR);
    let mut chart = chart(panel, title, ranges, axes)?;
    chart.draw_series([PathElement::new(
        points.iter().map(|(at, _)| *at).collect::<Vec<_>>(),
        LINE.stroke_width(1),
    )])?;
    for (at, setting) in points {
        chart.draw_series([Circle::new(*at, 4, LINE.filled())])?;
        let (x, y) = chart.plotting_area().map_coordinate(at);
        panel.draw_text(&setting.to_string(), &FONT.into_font().color(&BLACK), {
            let (left, top) = panel.get_base_pixel();
            (x - left + 8, y - top - 18)
        })?;
    }
    Ok(())
}
