//! The plot: error over seconds, both logarithmic; the estimated error over the true one beside it.

use super::super::plot::{Drawn, FONT, GRID, Plot, chart, ranges};
use super::figures::{Family, Point};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The plot of a set of points.
pub(super) struct IndirectPlot<'a>(pub(super) &'a [Point]);

const OTHERS: [(Family, RGBColor); 3] = [
    (Family::Paths, RGBColor(200, 30, 30)),
    (Family::Plain, RGBColor(150, 150, 150)),
    (Family::Clamped, RGBColor(120, 90, 50)),
];
/// Of curves of more and more virtual lights.
const GATHERED: [RGBColor; 5] = [
    RGBColor(190, 210, 250),
    RGBColor(130, 170, 240),
    RGBColor(70, 120, 220),
    RGBColor(20, 60, 170),
    RGBColor(0, 0, 60),
];
const FRONT: RGBColor = RGBColor(225, 225, 225);
/// Of the error; smaller ones are the truth's noise.
const LEAST: f64 = 1e-4;

impl Plot for IndirectPlot<'_> {
    const SIZE: (u32, u32) = (1560, 800);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        let (left, right) = root.split_horizontally(1020);
        errors(&left, self.0)?;
        estimates(&right, self.0)?;
        root.present()
    }
}

/// Curves in the order of their first points.
fn curves(points: &[Point]) -> Vec<(RGBColor, String, Vec<&Point>)> {
    let mut curves: Vec<Vec<&Point>> = Vec::new();
    for p in points {
        match curves.iter_mut().find(|curve| curve[0].along(p)) {
            Some(curve) => curve.push(p),
            None => curves.push(vec![p]),
        }
    }
    let mut blues = GATHERED
        .iter()
        .skip(GATHERED.len() - curves.iter().filter(|c| c[0].family == Family::Gathered).count());
    let styled = curves.into_iter().map(|curve| {
        let family = curve[0].family;
        let other = OTHERS.iter().find(|(other, _)| *other == family);
        match other {
            Some((_, color)) => (*color, family.name().to_owned(), curve),
            None => {
                let color = blues.next().copied().unwrap_or(BLACK);
                (color, format!("amas, {} lights a round", curve[0].count), curve)
            }
        }
    });
    styled.collect()
}

fn errors<B: DrawingBackend>(panel: &DrawingArea<B, Shift>, points: &[Point]) -> Drawn<B> {
    let at = |p: &Point| (p.cpu_s.median, p.error.max(LEAST));
    let ranges = ranges(points.iter().map(at), LEAST);
    let axes = "across: CPU seconds; up: RMS error over the mean; grey: the front; ringed: the default";
    let mut chart = chart(panel, "light by way of other surfaces", ranges, axes)?;
    let mut front: Vec<_> = points.iter().filter(|p| p.pareto).map(at).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart.draw_series([PathElement::new(front, FRONT.stroke_width(8))])?;
    for (color, name, curve) in curves(points) {
        let line: Vec<_> = curve.iter().map(|p| at(p)).collect();
        chart
            .draw_series([PathElement::new(line.clone(), color.stroke_width(2))])?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 24, y)], color.stroke_width(3)));
        chart.draw_series(line.iter().map(|&place| Circle::new(place, 3, color.filled())))?;
        let default = curve.iter().filter(|p| p.default);
        chart.draw_series(default.map(|p| Circle::new(at(p), 9, color.stroke_width(2))))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.85))
        .border_style(GRID[1])
        .label_font(FONT)
        .draw()
}

fn estimates<B: DrawingBackend>(panel: &DrawingArea<B, Shift>, points: &[Point]) -> Drawn<B> {
    let most = points.iter().map(|p| p.rounds).max().unwrap_or(1);
    let ratio = |p: &Point| p.estimate.map(|estimate| (f64::from(p.rounds), estimate / p.error.max(LEAST)));
    let ranges = [1.6..f64::from(most) * 1.25, 0.25..4.0];
    let mut chart = chart(panel, "estimated over true error", ranges, "across: rounds; up: ratio")?;
    chart.draw_series([PathElement::new(
        [(1.6, 1.0), (f64::from(most) * 1.25, 1.0)],
        BLACK.stroke_width(1),
    )])?;
    for (color, _, curve) in curves(points) {
        let line: Vec<_> = curve.iter().filter_map(|p| ratio(p)).collect();
        chart.draw_series([PathElement::new(line.clone(), color.stroke_width(2))])?;
        chart.draw_series(line.iter().map(|&place| Circle::new(place, 3, color.filled())))?;
    }
    Ok(())
}
