//! What the colours of a view stand for.

use super::compare::{Compare, Mode, WORST};
use super::views::{VIEWS, Views};
use crate::app::false_color::heat;
use egui::{Align2, Area, Color32, Context, Frame, Id, Mesh, Sense, Slider, Ui, pos2};

/// Of the bar of colours, points.
const BAR: [f32; 2] = [220.0, 12.0];

/// The legend at the lower edge, where there is something to explain.
pub(super) fn show(context: &Context, views: &Views, compare: &mut Compare, size: [u32; 2]) {
    if views.shown().is_none() && compare.mode == Mode::Off {
        return;
    }
    if compare.mode == Mode::Split {
        let rect = context.content_rect();
        let x = rect.left() + compare.column * rect.width();
        let painter = context.layer_painter(egui::LayerId::background());
        painter.vline(x, rect.y_range(), (1.0, Color32::GRAY));
    }
    Area::new(Id::unique("legend")).anchor(Align2::CENTER_BOTTOM, [0.0, -8.0]).show(context, |ui| {
        Frame::window(ui.style()).show(ui, |ui| {
            // An area is as wide as it was before, and would wrap what is longer.
            ui.set_max_width(context.content_rect().width() - 24.0);
            if let Some(view) = views.shown() {
                ui.strong(VIEWS[view].name);
                match views.range() {
                    Some([low, high]) if low == high => {
                        ui.label(format!("{} everywhere", number(low)));
                    }
                    Some([low, high]) => bar(ui, &number(low), &number(high)),
                    None => {}
                }
            }
            if compare.mode == Mode::Split {
                ui.label(format!("left: the picture; right: {}", compare.state(size)));
                ui.add(Slider::new(&mut compare.column, 0.0..=1.0).show_value(false));
            } else if compare.mode == Mode::Difference {
                ui.label(format!("relative error against: {}", compare.state(size)));
                bar(ui, "0", &format!("{:.0} %", 100.0 * WORST));
            }
        });
    });
}

fn bar(ui: &mut Ui, low: &str, high: &str) {
    ui.horizontal(|ui| {
        ui.label(low);
        // The numbers beside it take some 40 each.
        let width = BAR[0].min(ui.ctx().content_rect().width() - 120.0).max(40.0);
        let (rect, _) = ui.allocate_exact_size([width, BAR[1]].into(), Sense::hover());
        let steps: Vec<_> = (0..=20).map(|step| Some(step as f32)).collect();
        let mut mesh = Mesh::default();
        for (step, [r, g, b]) in heat(&steps, [0.0, 20.0]).into_iter().enumerate() {
            let x = rect.left() + step as f32 / 20.0 * rect.width();
            mesh.colored_vertex(pos2(x, rect.top()), Color32::from_rgb(r, g, b));
            mesh.colored_vertex(pos2(x, rect.bottom()), Color32::from_rgb(r, g, b));
            if step > 0 {
                let corner = 2 * step as u32 - 2;
                mesh.add_triangle(corner, corner + 1, corner + 2);
                mesh.add_triangle(corner + 1, corner + 2, corner + 3);
            }
        }
        ui.painter().add(mesh);
        ui.label(high);
    });
}

/// Three digits, and no more than the number needs.
fn number(x: f32) -> String {
    if x == x.round() && x.abs() < 1e6 {
        format!("{x}")
    } else if (1e-3..1e4).contains(&x.abs()) {
        format!("{x:.3}")
    } else {
        format!("{x:.2e}")
    }
}
