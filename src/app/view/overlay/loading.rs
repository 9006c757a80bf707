//! How far a scene is that is to take the place of the one in the window, and a button that ends it.

use crate::app::view::loading::Loading;
use crate::app::view::waiting;
use egui::{Align2, Area, Context, Frame, Id, ProgressBar};
use std::time::Duration;

/// Most scenes are there before: a bar would only flicker.
const PATIENCE: Duration = Duration::from_millis(500);

/// What is being loaded.
pub(super) struct Job {
    name: String,
    /// From 0 to 1.
    fraction: f64,
}

impl Job {
    /// `None` where it began a moment ago.
    pub(super) fn of(loading: &Loading) -> Option<Self> {
        loading.since.elapsed().is_ok_and(|time| time > PATIENCE).then(|| Self {
            name: loading.options.scene.as_deref().map_or("the embedded scene".into(), |path| {
                path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
            }),
            fraction: loading.fraction(),
        })
    }

    /// The bar, as wide as that before the first picture; whether the user ends it.
    pub(super) fn show(&self, context: &Context) -> bool {
        let area = Area::new(Id::unique("loading")).anchor(Align2::CENTER_TOP, [0.0, 8.0]);
        let shown = area.show(context, |ui| {
            Frame::window(ui.style()).show(ui, |ui| {
                let width = 0.5 * context.content_rect().width();
                ui.set_width(width);
                let button = ui.horizontal(|ui| {
                    let button = ui.button("Cancel");
                    let what = format!("{:.0} % of {}", 100.0 * self.fraction, self.name);
                    ui.add(egui::Label::new(what).truncate());
                    button
                });
                let [r, g, b, _] = waiting::DONE;
                let bar = ProgressBar::new(self.fraction as f32).desired_width(width);
                ui.add(bar.fill(egui::Color32::from_rgb(r, g, b)));
                button.inner.clicked()
            })
        });
        shown.inner.inner
    }
}
