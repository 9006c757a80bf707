//! The plot: error over time, both logarithmic, one panel a band.

use super::super::plot::{Drawn, Label, Plot, chart, draw_labels, ranges, within};
use super::configurations::BANDS;
use super::figures::Point;
use super::tiers::Family;
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (1560, 800);
pub(super) const FAMILIES: [(Family, RGBColor); 7] = [
    (Family::Representative, RGBColor(200, 30, 30)),
    (Family::Cubature, RGBColor(30, 90, 200)),
    (Family::ClosedForm, RGBColor(150, 40, 170)),
    (Family::Quadrature, RGBColor(20, 130, 60)),
    (Family::Shipped, RGBColor(0, 0, 0)),
    (Family::AreaSamples, RGBColor(220, 120, 0)),
    (Family::ProxySamples, RGBColor(120, 90, 50)),
];

const AXES: &str =
    "across: ns per light and pixel; up: mean relative error; ringed: nothing is both faster and more exact";
/// Of times and errors, for their logarithms.
const LEAST: f64 = 1e-9;

/// The plot of a set of points.
pub(super) struct AreaPlot<'a>(pub(super) &'a [Point]);

impl Plot for AreaPlot<'_> {
    const SIZE: (u32, u32) = SIZE;

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        draw(root, self.0)
    }
}

fn draw<B: DrawingBackend>(root: &DrawingArea<B, Shift>, points: &[Point]) -> Drawn<B> {
    root.fill(&WHITE)?;
    let summary: Vec<&Point> = points.iter().filter(|p| p.summary()).collect();
    let mut labels = Vec::new();
    let panels = root.split_evenly((1, BANDS.len()));
    for ((band, alphas), panel) in BANDS.into_iter().zip(&panels) {
        let alphas: Vec<_> = alphas.iter().map(f64::to_string).collect();
        let at = |p: &Point| (p.ns.max(LEAST), p.error.max(LEAST));
        let [ns, error] = ranges(summary.iter().map(|p| at(p)), LEAST);
        // Room for the last labels.
        let wider = [ns.start..2.0 * ns.end, error];
        let mut chart = chart(panel, &format!("{band}: alpha {}", alphas.join(", ")), wider, AXES)?;
        let own: Vec<&&Point> = summary.iter().filter(|p| p.band == band).collect();
        let mut front: Vec<_> = own.iter().filter(|p| p.pareto).map(|p| at(p)).collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        chart.draw_series([PathElement::new(front.clone(), RGBColor(190, 190, 190).stroke_width(5))])?;
        for (family, color) in FAMILIES {
            let members: Vec<&&&Point> = own.iter().filter(|p| p.family == family).collect();
            if family.random() {
                let line: Vec<_> = members.iter().map(|p| at(p)).collect();
                chart.draw_series([PathElement::new(line, color.stroke_width(1))])?;
            }
            for p in members {
                let size = if family == Family::Shipped { 6 } else { 4 };
                chart.draw_series([Circle::new(at(p), size, color.filled())])?;
                if p.pareto {
                    chart.draw_series([Circle::new(at(p), size + 3, color.stroke_width(1))])?;
                }
                let at = chart.plotting_area().map_coordinate(&at(p));
                let within = within(panel);
                labels.push(Label { at, text: p.tier.to_owned(), color, within });
            }
        }
    }
    draw_labels(root, &labels)?;
    root.present()
}
