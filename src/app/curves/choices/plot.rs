//! The plot: error of tables over their bytes, both logarithmic, a panel a layer.

use super::super::plot::{Drawn, Label, Plot, chart, draw_labels, ranges, within};
use super::tables::Stored;
use plotters::coord::Shift;
use plotters::prelude::*;

/// The plot of a set of tables.
pub(super) struct ChoicesPlot<'a>(pub(super) &'a [Stored]);

const LINE: RGBColor = RGBColor(30, 90, 200);
const OWN_FITS: RGBColor = RGBColor(200, 30, 30);
/// Of errors.
const LEAST: f64 = 1e-6;
const AXES: &str = "across: bytes of a layer; up: mean error; line: own fits; ringed: the default";

impl Plot for ChoicesPlot<'_> {
    const SIZE: (u32, u32) = (1560, 620);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        let layers: Vec<&[Stored]> = self.0.chunk_by(|a, b| a.layer == b.layer).collect();
        let mut labels = Vec::new();
        for (tables, panel) in layers.iter().zip(root.split_evenly((1, layers.len()))) {
            labels.extend(draw_panel(&panel, tables)?);
        }
        draw_labels(root, &labels)?;
        root.present()
    }
}

/// One layer's tables; their labels.
fn draw_panel<B: DrawingBackend>(
    panel: &DrawingArea<B, Shift>,
    tables: &[Stored],
) -> Result<Vec<Label>, DrawingAreaErrorKind<B::ErrorType>> {
    let sized = || tables.iter().filter_map(|table| Some((table, table.bytes? as f64)));
    let own_fits = tables.iter().filter(|table| table.side.is_none()).map(|table| table.mean.max(LEAST));
    let all = own_fits.clone().flat_map(|mean| sized().map(move |(_, bytes)| (bytes, mean)));
    let [bytes, error] = ranges(sized().map(|(table, bytes)| (bytes, table.mean)).chain(all), LEAST);
    // Room for the labels.
    let wider = bytes.start..8.0 * bytes.end;
    let largest = sized().map(|(_, bytes)| bytes).fold(bytes.start, f64::max);
    let title = tables.first().map_or("", |table| table.layer);
    let mut chart = chart(panel, title, [wider, error], AXES)?;
    for mean in own_fits {
        let ends = [(bytes.start, mean), (largest, mean)];
        chart.draw_series([PathElement::new(ends, OWN_FITS.stroke_width(1))])?;
    }
    let within = within(panel);
    let mut labels = Vec::new();
    for (table, bytes) in sized() {
        let at = (bytes, table.mean.max(LEAST));
        chart.draw_series([Circle::new(at, 4, LINE.filled())])?;
        if table.default {
            chart.draw_series([Circle::new(at, 9, LINE.stroke_width(2))])?;
        }
        let side = table.side.unwrap_or_default();
        let text = format!("{side} x {side}, {}", table.format.name());
        labels.push(Label { at: chart.plotting_area().map_coordinate(&at), text, color: LINE, within });
    }
    Ok(labels)
}
