//! The plot: frame time over what is counted, a panel a sweep; other programs beside the point lights.

use super::super::plot::{Drawn, FONT, GRID, Plot, chart, ranges};
use super::peers::PEERS;
use super::sweeps::{LIGHTS, SWEEPS, Sweep};
use super::{Figures, Growth, Point, fitted};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The plot of a set of points.
pub(super) struct ScalingPlot<'a>(pub(super) &'a Figures);

const LINE: RGBColor = RGBColor(30, 90, 200);
const FIT: RGBColor = RGBColor(170, 170, 170);
const PEER_COLORS: [RGBColor; PEERS.len()] = [
    RGBColor(200, 30, 30),
    RGBColor(220, 120, 0),
    RGBColor(20, 130, 60),
    RGBColor(150, 40, 170),
    RGBColor(120, 90, 50),
];
/// Of counts and of milliseconds.
const LEAST: f64 = 1e-3;

type Places = Vec<(f64, f64)>;

impl Plot for ScalingPlot<'_> {
    const SIZE: (u32, u32) = (1560, 1000);

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        for (sweep, panel) in SWEEPS.iter().zip(root.split_evenly((2, 2))) {
            let own: Vec<&Point> =
                self.0.points.iter().filter(|p| p.sweep == sweep.name && p.count > 0).collect();
            let growth = self.0.growth.iter().find(|growth| growth.sweep == sweep.name);
            draw_panel(&panel, sweep, &own, growth)?;
        }
        root.present()
    }
}

fn draw_panel<B: DrawingBackend>(
    panel: &DrawingArea<B, Shift>,
    sweep: &Sweep,
    points: &[&Point],
    growth: Option<&Growth>,
) -> Drawn<B> {
    let own: Places = points.iter().map(|p| (p.count as f64, p.frame_ms.median)).collect();
    let peers = if sweep.name == LIGHTS { peers() } else { Vec::new() };
    let all = own.iter().chain(peers.iter().flat_map(|(.., places)| places)).copied();
    let axes = format!("across: {}; up: milliseconds a frame", sweep.name);
    let mut chart = chart(panel, sweep.name, ranges(all, LEAST), &axes)?;
    if let Some(growth) = growth {
        chart
            .draw_series([PathElement::new(line(points, growth.slope), FIT.stroke_width(9))])?
            .label(format!("slope {:.2}", growth.slope))
            .legend(|(x, y)| PathElement::new([(x, y), (x + 24, y)], FIT.stroke_width(5)));
    }
    let own = [("amas".to_owned(), LINE, own)];
    for (name, color, places) in own.into_iter().chain(peers) {
        chart
            .draw_series([PathElement::new(places.clone(), color.stroke_width(2))])?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 24, y)], color.stroke_width(3)));
        chart.draw_series(places.into_iter().map(|place| Circle::new(place, 4, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.85))
        .border_style(GRID[1])
        .label_font(FONT)
        .draw()
}

/// Others' frames: CPU time, or wall time where that is all there is.
fn peers() -> Vec<(String, RGBColor, Places)> {
    let one = |(peer, color): (&super::peers::Peer, RGBColor)| {
        let what = if peer.frames.iter().any(|frame| frame.cpu_ms.is_none()) { ", wall" } else { "" };
        let lit = peer.frames.iter().filter(|frame| frame.lights > 0);
        let places = lit.map(|frame| (frame.lights as f64, frame.cpu_ms.unwrap_or(frame.wall_ms)));
        (format!("{}, {}{what}", peer.name, peer.driver), color, places.collect())
    };
    PEERS.iter().zip(PEER_COLORS).map(one).collect()
}

/// The fitted line over the points that it is of; it goes through the mean of their logarithms.
fn line(points: &[&Point], slope: f64) -> Places {
    let count = fitted(points).count() as f64;
    let mean = |of: fn((f64, f64)) -> f64| fitted(points).map(|p| of(p).ln()).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    fitted(points).map(|p| (p.0, (y + slope * (p.0.ln() - x)).exp())).collect()
}
