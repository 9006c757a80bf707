//! The keys, as the window lists them and as `amas view --help` does.

use egui::Context;

/// Keys and what they do.
pub(in crate::app::view) const KEYS: [(&str, &str); 7] = [
    ("W A S D", "forward, left, backward, right (by place on the keyboard)"),
    ("Q E", "down, up"),
    ("mouse drag", "look around"),
    ("wheel", "fly faster or slower"),
    ("O", "panels: times, counts, settings"),
    ("?", "these keys"),
    ("Esc", "close"),
];

pub(super) fn show(context: &Context, open: &mut bool) {
    let window = egui::Window::new("Keys").open(open).collapsible(false).resizable(false);
    window.anchor(egui::Align2::RIGHT_TOP, [-8.0, 8.0]).show(context, |ui| {
        egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
            for (key, what) in KEYS {
                ui.strong(key);
                ui.label(what);
                ui.end_row();
            }
        });
    });
}
