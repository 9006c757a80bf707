//! The panels: times, view, counts, settings, what is picked.

use super::compare::Mode;
use super::picked::project;
use super::settings::{self, Change};
use super::views::VIEWS;
use super::{Gui, gathered};
use crate::app::view::gathering::Status;
use crate::scene::{Camera, Scene};
use egui::{Color32, ComboBox, Context, LayerId, ScrollArea, Ui, pos2};
use std::sync::Arc;

/// On hot reload of shaders.
const WATCHED: &str = "Changes in glsl/ are compiled and shown at once.";
const NOT_WATCHED: &str = "The checkout that amas was built from is not here: shaders stay as they are.";

/// Width of the panels, points.
const WIDTH: f32 = 280.0;

impl Gui {
    pub(super) fn panels(
        &mut self,
        context: &Context,
        scene: &mut Arc<Scene>,
        status: Option<Status>,
    ) -> Change {
        let mut change = Change::Nothing;
        let window = egui::Window::new("amas").default_pos([8.0, 8.0]).default_width(WIDTH);
        window.default_height(context.content_rect().height() - 64.0).show(context, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                section(ui, "Time", |ui| self.history.show(ui));
                section(ui, "View", |ui| self.choose(ui));
                if let Some(status) = status {
                    section(ui, "Gathered light", |ui| gathered::show(ui, status));
                }
                if let Some(figures) = &self.figures {
                    section(ui, "Counts", |ui| figures.show(ui));
                }
                section(ui, "Settings", |ui| change = settings::show(ui, scene));
                section(ui, "Picked", |ui| change = change.max(self.inspector.show(ui, scene)));
                section(ui, "Shaders", |ui| {
                    ui.weak(if self.watched { WATCHED } else { NOT_WATCHED });
                });
                section(ui, "Save", |ui| self.inspector.save(ui, scene));
            });
        });
        change
    }

    /// Why shaders or a scene are not shown, beside the panels.
    pub(super) fn complaints(&mut self, context: &Context) {
        let left = if self.panels { WIDTH + 80.0 } else { 8.0 };
        let mut top = 8.0;
        for (title, trouble) in [("Shaders", &mut self.trouble), ("Scene", &mut self.refused)] {
            trouble.take_if(|trouble| !complain(context, title, trouble, [left, top]));
            top += if trouble.is_some() { 180.0 } else { 0.0 };
        }
    }

    /// The debug views and comparisons, as the keys have them.
    fn choose(&mut self, ui: &mut Ui) {
        let mut shown = self.views.shown();
        ComboBox::from_id_salt("view")
            .selected_text(shown.map_or("picture", |view| VIEWS[view].name))
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut shown, None, "picture");
                for (index, view) in VIEWS.iter().enumerate() {
                    ui.selectable_value(&mut shown, Some(index), view.name);
                }
            });
        self.views.show(shown);
        let mut mode = self.compare.mode;
        ui.horizontal(|ui| {
            for (name, value) in [("alone", Mode::Off), ("split", Mode::Split), ("error", Mode::Difference)] {
                ui.radio_value(&mut mode, value, name);
            }
        });
        while mode != self.compare.mode {
            self.compare.next();
        }
    }

    /// A ring around the light that is picked.
    pub(super) fn mark(&self, context: &Context, scene: &Scene, camera: &Camera, size: [u32; 2]) {
        let place = self.inspector.picked.and_then(|picked| picked.place(scene));
        let Some([x, y, _]) = place.and_then(|place| project(camera, size, place.as_dvec3())) else {
            return;
        };
        let scale = context.pixels_per_point();
        let painter = context.layer_painter(LayerId::background());
        painter.circle_stroke(pos2(x as f32 / scale, y as f32 / scale), 8.0, (1.5, Color32::WHITE));
        painter.circle_stroke(pos2(x as f32 / scale, y as f32 / scale), 9.5, (1.5, Color32::BLACK));
    }
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(title).default_open(true).show(ui, contents);
}

/// What went wrong, in a window at a place, that can be closed; whether it stays.
fn complain(context: &Context, title: &str, trouble: &str, place: [f32; 2]) -> bool {
    let mut open = true;
    let window = egui::Window::new(title).open(&mut open).collapsible(false).current_pos(place);
    window.show(context, |ui| {
        ScrollArea::both().max_height(120.0).show(ui, |ui| {
            ui.label(egui::RichText::new(trouble).monospace().color(Color32::LIGHT_RED));
        });
    });
    open
}
