//! The scenes that were shown before, to choose from.

use crate::app::view::recent::Recent;
use egui::{Align2, Context};
use std::path::PathBuf;

/// The list; the scene that is clicked.
pub(super) fn show(context: &Context, recent: &Recent, open: &mut bool) -> Option<PathBuf> {
    let mut chosen = None;
    let window = egui::Window::new("Scenes").open(open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0; 2]).show(context, |ui| {
        if recent.scenes().is_empty() {
            ui.weak("None but the one that is part of the program.");
        }
        for (number, scene) in (1..).zip(recent.scenes()) {
            if ui.button(format!("{number}  {}", scene.display())).clicked() {
                chosen = Some(scene.clone());
            }
        }
    });
    *open &= chosen.is_none();
    chosen
}
