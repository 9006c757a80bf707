//! The plot: error over CPU time, both logarithmic.

use super::super::plot::{Drawn, FONT, GRID, Plot, chart, ranges};
use super::{FAMILIES, Family, Point};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The plot of a set of points.
pub(super) struct SamplesPlot<'a>(pub(super) &'a [Point]);

/// Of errors and milliseconds.
const LEAST: f64 = 1e-6;

const fn color(family: Family) -> RGBColor {
    match family {
        Family::Shadows => RGBColor(30, 90, 200),
        Family::Unshadowed => RGBColor(20, 130, 60),
        Family::Paths => RGBColor(200, 30, 30),
    }
}

impl Plot for SamplesPlot<'_> {
    const SIZE: (u32, u32) = (1000, 700);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        let at = |p: &Point| (p.cpu_ms.median.max(LEAST), p.error.max(LEAST));
        let axes =
            "across: CPU ms; up: RMS error over the mean; labels: samples a pixel; ringed: the default";
        let mut chart = chart(root, "shadows of area lights", ranges(self.0.iter().map(at), LEAST), axes)?;
        for family in FAMILIES {
            let color = color(family);
            let own = || self.0.iter().filter(|p| p.family == family);
            chart
                .draw_series([PathElement::new(own().map(at).collect::<Vec<_>>(), color.stroke_width(2))])?
                .label(family.name())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 24, y)], color.stroke_width(3)));
            for p in own() {
                chart.draw_series([Circle::new(at(p), 4, color.filled())])?;
                if p.default {
                    chart.draw_series([Circle::new(at(p), 9, color.stroke_width(2))])?;
                }
                let (x, y) = chart.plotting_area().map_coordinate(&at(p));
                root.draw_text(&p.samples.to_string(), &FONT.into_font().color(&BLACK), (x + 9, y - 16))?;
            }
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .background_style(WHITE.mix(0.85))
            .border_style(GRID[1])
            .label_font(FONT)
            .draw()?;
        root.present()
    }
}
