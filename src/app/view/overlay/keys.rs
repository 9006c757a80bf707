//! The keys, as `amas view --help` lists them, too.

use crate::app::keys::KEYS;
use egui::Context;

pub(super) fn show(context: &Context, open: &mut bool) {
    let window = egui::Window::new("Keys").open(open).collapsible(false).resizable(false);
    window.anchor(egui::Align2::RIGHT_TOP, [-8.0, 8.0]).show(context, |ui| {
        // In small windows, too, all of them can be reached.
        egui::ScrollArea::both().show(ui, |ui| {
            egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
                for (key, what) in KEYS {
                    ui.strong(key);
                    ui.label(what);
                    ui.end_row();
                }
            });
        });
    });
}
