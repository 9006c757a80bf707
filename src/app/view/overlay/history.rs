//! What samples cost: a rolling plot, stacked pass by pass, and bars of the last.

use super::PASS_COLORS;
use crate::frame::Timings;
use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Shape, Ui, pos2, vec2};
use std::collections::VecDeque;

/// Samples in the plot.
const SAMPLES: usize = 160;
/// Height of the plot and of a bar, points.
const PLOT: f32 = 72.0;
const BAR: f32 = 14.0;

/// Every pass that a frame may have, in frame order; their colours stay the same whatever the scene uses.
const PASSES: [&str; 8] =
    ["lights", "prepass", "cluster", "resolve", "direct", "indirect", "present", "gather"];

/// What the last samples cost.
#[derive(Default)]
pub(super) struct History(VecDeque<Cost>);

struct Cost {
    /// Milliseconds, pass by pass.
    passes: [f64; PASSES.len()],
    /// All of it, with what is of no pass.
    wall: f64,
}

impl History {
    /// Takes note of a sample.
    pub(super) fn add(&mut self, timings: &Timings) {
        let mut passes = [0.0; PASSES.len()];
        for pass in &timings.passes {
            if let Some(index) = PASSES.iter().position(|&name| name == pass.name) {
                passes[index] += pass.gpu_ms.or(pass.cpu_ms).unwrap_or(0.0);
            }
        }
        self.0.push_back(Cost { passes, wall: timings.wall_ms });
        if self.0.len() > SAMPLES {
            self.0.pop_front();
        }
    }

    /// Plot and bars.
    pub(super) fn show(&self, ui: &mut Ui) {
        let Some(last) = self.0.back() else { return };
        let highest = self.0.iter().map(|cost| cost.wall.max(cost.passes.iter().sum())).fold(0.0, f64::max);
        let top = nice_above(highest);
        self.plot(ui, top);
        for (index, name) in PASSES.iter().enumerate() {
            if self.0.iter().any(|cost| cost.passes[index] > 0.0) {
                bar(ui, name, last.passes[index], top, PASS_COLORS[index]);
            }
        }
        bar(ui, "frame", last.wall, top, Color32::GRAY);
    }

    fn plot(&self, ui: &mut Ui, top: f64) {
        let (response, painter) = ui.allocate_painter(vec2(ui.available_width(), PLOT), Sense::hover());
        let rect = response.rect;
        painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
        let at = |sample: usize, ms: f64| -> Pos2 {
            let x = rect.right() - (self.0.len() - 1 - sample) as f32 / SAMPLES as f32 * rect.width();
            pos2(x, rect.bottom() - (ms / top).min(1.0) as f32 * rect.height())
        };
        let mut base = vec![0.0; self.0.len()];
        for (pass, &color) in PASS_COLORS.iter().enumerate() {
            let above: Vec<f64> = base.iter().zip(&self.0).map(|(b, cost)| b + cost.passes[pass]).collect();
            painter.add(band(&base, &above, at, color));
            base = above;
        }
        let wall = self.0.iter().enumerate().map(|(i, cost)| at(i, cost.wall)).collect();
        painter.add(Shape::line(wall, (1.0, Color32::GRAY)));
        let label = format!("{top} ms");
        painter.text(rect.left_top(), Align2::LEFT_TOP, label, FontId::monospace(9.0), Color32::GRAY);
    }
}

/// The area between two curves, one point a sample.
fn band(lower: &[f64], upper: &[f64], at: impl Fn(usize, f64) -> Pos2, color: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    for sample in 0..lower.len() {
        mesh.colored_vertex(at(sample, lower[sample]), color);
        mesh.colored_vertex(at(sample, upper[sample]), color);
        if sample > 0 {
            let corner = 2 * sample as u32 - 2;
            mesh.add_triangle(corner, corner + 1, corner + 2);
            mesh.add_triangle(corner + 1, corner + 2, corner + 3);
        }
    }
    mesh
}

fn bar(ui: &mut Ui, name: &str, ms: f64, top: f64, color: Color32) {
    let (response, painter) = ui.allocate_painter(vec2(ui.available_width(), BAR), Sense::hover());
    let rect = response.rect;
    let width = (ms / top).min(1.0) as f32 * rect.width();
    painter.rect_filled(
        Rect::from_min_size(rect.min, vec2(width, BAR - 2.0)),
        1.0,
        color.gamma_multiply(0.7),
    );
    let font = FontId::monospace(10.0);
    let text = ui.visuals().strong_text_color();
    painter.text(rect.left_top() + vec2(3.0, 0.0), Align2::LEFT_TOP, name, font.clone(), text);
    painter.text(rect.right_top(), Align2::RIGHT_TOP, format!("{ms:.2} ms"), font, text);
}

/// The least of 1, 2, 5, 10, 20 … that is not below.
fn nice_above(ms: f64) -> f64 {
    let decade = 10_f64.powf(ms.max(1e-3).log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|step| step * decade)
        .find(|&top| top >= ms)
        .unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::PassTime;

    #[test]
    fn scales_end_on_round_numbers() {
        for (ms, top) in [(0.7, 1.0), (1.0, 1.0), (1.1, 2.0), (30.0, 50.0), (51.0, 100.0), (0.0, 0.001)] {
            assert!((nice_above(ms) / top - 1.0).abs() < 1e-9, "{ms}: {}", nice_above(ms));
        }
    }

    #[test]
    fn device_time_counts_where_it_is_known() {
        let pass = |name, gpu_ms| PassTime { name, gpu_ms, cpu_ms: Some(9.0) };
        let passes = vec![pass("prepass", Some(4.0)), pass("indirect", None), pass("present", Some(1.0))];
        let mut history = History::default();
        history.add(&Timings { passes, wall_ms: 40.0, cpu_ms: 70.0 });
        let Cost { passes, wall } = &history.0[0];
        assert_eq!((*wall, *passes), (40.0, [0.0, 4.0, 0.0, 0.0, 0.0, 9.0, 1.0, 0.0]));
        for _ in 0..2 * SAMPLES {
            history.add(&Timings { passes: vec![], wall_ms: 1.0, cpu_ms: 1.0 });
        }
        assert_eq!(history.0.len(), SAMPLES);
    }
}
