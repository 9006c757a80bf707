//! The settings of the picture, `[render]` of the scene.

use crate::gpu_scene::Edit;
use crate::scene::settings::Tonemap;
use crate::scene::{RenderSettings, Scene};
use egui::{DragValue, Slider, Ui};
use std::sync::Arc;

/// What a change asks for: each holds the ones before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::app::view) enum Change {
    Nothing,
    /// The picture anew.
    Picture,
    /// A small change of the scene.
    Edit(Edit),
    /// The frame under other settings.
    Frame,
    /// The scene on the device.
    Scene,
}

/// As many as a scene file may ask for.
const MOST_VPLS: u32 = 1 << 20;
/// Virtual lights of a scene that had none before.
const VPLS: u32 = 1 << 16;

/// The settings of a scene.
pub(super) fn show(ui: &mut Ui, scene: &mut Arc<Scene>) -> Change {
    // Others hold the scene, too: it is copied where something changes, and only there.
    let mut render = scene.render.clone();
    rows(ui, &mut render);
    let change = change(&scene.render, &render, !scene.area_lights.is_empty());
    if change > Change::Nothing {
        Arc::make_mut(scene).render = render;
    }
    change
}

fn rows(ui: &mut Ui, render: &mut RenderSettings) {
    egui::Grid::new("settings").num_columns(2).show(ui, |ui| {
        let mut row = |name: &str, hint: &str, add: &mut dyn FnMut(&mut Ui)| {
            ui.label(name).on_hover_text(hint);
            add(ui);
            ui.end_row();
        };
        row("exposure", "EV", &mut |ui| {
            ui.add(Slider::new(&mut render.exposure, -10.0..=10.0).clamping(egui::SliderClamping::Never));
        });
        row("tone curve", "none clamps", &mut |ui| {
            ui.horizontal(|ui| {
                for (name, curve) in [("none", Tonemap::None), ("ACES", Tonemap::Aces), ("AgX", Tonemap::Agx)]
                {
                    ui.radio_value(&mut render.tonemap, curve, name);
                }
            });
        });
        row("samples", "of the picture at rest", &mut |ui| {
            ui.add(DragValue::new(&mut render.samples).range(1..=65536));
        });
        row("light_error", "relative error that light may have; 0 evaluates every light", &mut |ui| {
            let slider = Slider::new(&mut render.light_error, 0.0..=1.0).logarithmic(true);
            ui.add(slider.smallest_positive(0.001).largest_finite(1.0));
        });
        row("lights a cluster", "longest list; the rest is folded", &mut |ui| {
            ui.add(DragValue::new(&mut render.max_lights_per_cluster).range(128..=2048));
        });
        row("shadows", "of every light", &mut |ui| {
            ui.checkbox(&mut render.shadows, "");
        });
        row("indirect light", "while the view rests", &mut |ui| {
            switch(ui, &mut render.vpls);
        });
        if render.vpls == 0 {
            return;
        }
        row("vpls", "virtual lights of a round", &mut |ui| {
            let most = 1..=MOST_VPLS;
            ui.add(Slider::new(&mut render.vpls, most).logarithmic(true).update_while_editing(false));
        });
        row("bounces", "of indirect light", &mut |ui| {
            ui.add(DragValue::new(&mut render.bounces).range(0..=64).update_while_editing(false));
        });
    });
}

/// Whether there are virtual lights; off and on again, as many as before.
fn switch(ui: &mut Ui, vpls: &mut u32) {
    let before = egui::Id::unique("vpls before");
    let mut on = *vpls > 0;
    if ui.checkbox(&mut on, "").changed() {
        let had = std::mem::take(vpls);
        if on {
            *vpls = ui.data(|data| data.get_temp(before)).unwrap_or(VPLS);
        } else {
            ui.data_mut(|data| data.insert_temp(before, had));
        }
    }
}

/// What lies between two settings. Which lobes may take closed forms of area lights, `light_error` decides when the scene is
/// uploaded.
fn change(before: &RenderSettings, after: &RenderSettings, areas: bool) -> Change {
    let picture = RenderSettings { exposure: after.exposure, samples: after.samples, ..before.clone() };
    if before == after {
        Change::Nothing
    } else if before.shadows != after.shadows
        || (before.vpls > 0) != (after.vpls > 0)
        || areas && before.light_error != after.light_error
    {
        Change::Scene
    } else if picture == *after {
        Change::Picture
    } else {
        Change::Frame
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_made_anew_that_need_not_be() {
        let before = RenderSettings::default();
        let of = |edit: fn(&mut RenderSettings)| {
            let mut after = before.clone();
            edit(&mut after);
            change(&before, &after, false)
        };
        assert_eq!(of(|_| {}), Change::Nothing);
        assert_eq!(of(|render| render.exposure = 1.0), Change::Picture);
        assert_eq!(of(|render| render.samples = 9), Change::Picture);
        assert_eq!(of(|render| render.tonemap = Tonemap::Aces), Change::Frame);
        assert_eq!(of(|render| render.light_error = 0.5), Change::Frame);
        let exact = RenderSettings { light_error: 0.0, ..before.clone() };
        assert_eq!(change(&before, &exact, true), Change::Scene);
        assert_eq!(of(|render| render.vpls = 64), Change::Scene);
        let indirect = RenderSettings { vpls: 64, ..before.clone() };
        for after in [
            RenderSettings { vpls: 128, ..indirect.clone() },
            RenderSettings { bounces: 1, ..indirect.clone() },
        ] {
            assert_eq!(change(&indirect, &after, false), Change::Frame);
        }
        assert_eq!(of(|render| (render.shadows, render.exposure) = (true, 1.0)), Change::Scene);
    }
}
