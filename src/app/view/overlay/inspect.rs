//! The part of the scene that was picked: what it is, and its values to change.

use super::document::{self, Row, rows};
use super::picked::{Item, Picked};
use super::settings::Change;
use crate::gpu_scene::Edit;
use crate::scene::light::AreaLight;
use crate::scene::{AreaShape, Material, PointLight, RenderSettings, Scene};
use egui::{DragValue, Grid, Slider, TextEdit, Ui};
use glam::Vec3;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// What is picked, what was changed, and where to save it.
#[derive(Default)]
pub(super) struct Inspector {
    pub(super) picked: Option<Picked>,
    /// What the parts that were changed were before.
    before: BTreeMap<Picked, Item>,
    /// `[render]` as it was loaded.
    render: Option<RenderSettings>,
    path: String,
    /// What came of the last attempt to save.
    message: String,
}

impl Inspector {
    /// A scene was loaded: nothing of it is changed yet.
    pub(super) fn begin(&mut self, scene: &Scene) {
        let path = scene.files.first().map(|path| path.with_extension("edited.toml")).unwrap_or_default();
        *self =
            Self { render: Some(scene.render.clone()), path: path.display().to_string(), ..Self::default() };
    }

    /// The picked part and its values.
    pub(super) fn show(&mut self, ui: &mut Ui, scene: &mut Arc<Scene>) -> Change {
        let Some((picked, mut item)) = self.picked.and_then(|picked| Some((picked, picked.of(scene)?)))
        else {
            ui.weak("I picks what is under the pointer.");
            return Change::Nothing;
        };
        let before = item.clone();
        let change = match &mut item {
            Item::Material(value) => material(ui, value),
            Item::Point(value) => point(ui, value),
            Item::Area(value) => area(ui, value),
        };
        if change > Change::Nothing {
            self.before.entry(picked).or_insert(before);
            put(Arc::make_mut(scene), picked, item);
        }
        match change {
            Change::Edit(Edit::Material(_)) => Change::Edit(Edit::Material(match picked {
                Picked::Material(index) => index,
                _ => 0,
            })),
            change => change,
        }
    }

    /// Where to save the scene with its changes.
    pub(super) fn save(&mut self, ui: &mut Ui, scene: &Scene) {
        let Some(original) = scene.files.first() else {
            ui.weak("The embedded scene cannot be saved.");
            return;
        };
        ui.add(TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY));
        if ui.button("Save with its changes").clicked() {
            let render = self.render.as_ref().unwrap_or(&scene.render);
            self.message =
                match document::save(original, &PathBuf::from(&self.path), scene, render, &self.before) {
                    Ok(left_out) if left_out.is_empty() => format!("{} is written.", self.path),
                    Ok(left_out) => left_out.join("\n"),
                    Err(error) => error.to_string(),
                };
        }
        ui.label(&self.message);
    }
}

fn put(scene: &mut Scene, picked: Picked, item: Item) {
    match (picked, item) {
        (Picked::Material(index), Item::Material(value)) => scene.materials[index] = *value,
        (Picked::Point(index), Item::Point(value)) => scene.point_lights[index] = value,
        (Picked::Area(index), Item::Area(value)) => scene.area_lights[index] = value,
        _ => {}
    }
}

fn material(ui: &mut Ui, material: &mut Material) -> Change {
    let before = material.clone();
    ui.strong(format!("material {:?}, {:?}", material.name, material.model).to_lowercase());
    Grid::new("material").num_columns(2).show(ui, |ui| {
        for Row { parameter, key, channels, most } in rows(material) {
            ui.label(key);
            let value = &mut material.parameters[parameter as usize];
            if value.texture.is_some() {
                ui.weak("a texture");
            } else if channels == 3 {
                color(ui, &mut value.constant, most);
            } else {
                ui.add(Slider::new(&mut value.constant[0], 0.0..=most));
            }
            ui.end_row();
        }
        ui.label("two_sided");
        ui.checkbox(&mut material.two_sided, "");
        ui.end_row();
    });
    // Of which index, the caller knows.
    if *material == before { Change::Nothing } else { Change::Edit(Edit::Material(0)) }
}

fn point(ui: &mut Ui, light: &mut PointLight) -> Change {
    let before = *light;
    ui.strong("point light");
    Grid::new("point").num_columns(2).show(ui, |ui| {
        row(ui, "position", |ui| vector(ui, &mut light.position));
        row(ui, "intensity", |ui| radiance(ui, &mut light.intensity));
        row(ui, "range", |ui| {
            let mut range = light.range.unwrap_or(0.0);
            let speed = 0.01 * range.max(0.1);
            ui.add(DragValue::new(&mut range).range(0.0..=1e6).speed(speed));
            light.range = (range > 0.0).then_some(range);
        });
    });
    ui.weak("W/sr; metres; range 0: none");
    if *light == before { Change::Nothing } else { Change::Edit(Edit::PointLights) }
}

fn area(ui: &mut Ui, light: &mut AreaLight) -> Change {
    let before = light.clone();
    ui.strong(match light.shape {
        AreaShape::Polygon { .. } => "polygon",
        AreaShape::Rect { .. } => "rect",
        AreaShape::Disk { .. } => "disk",
        AreaShape::Line { .. } => "line",
    });
    Grid::new("area").num_columns(2).show(ui, |ui| {
        row(ui, "radiance", |ui| radiance(ui, &mut light.radiance));
        match &mut light.shape {
            AreaShape::Rect { center, .. } | AreaShape::Disk { center, .. } => {
                row(ui, "center", |ui| vector(ui, center));
            }
            AreaShape::Line { a, b, .. } => {
                row(ui, "a", |ui| vector(ui, a));
                row(ui, "b", |ui| vector(ui, b));
            }
            AreaShape::Polygon { .. } => {}
        }
        row(ui, "two_sided", |ui| {
            ui.checkbox(&mut light.two_sided, "");
        });
        row(ui, "visible", |ui| {
            ui.checkbox(&mut light.visible, "");
        });
    });
    ui.weak("W/sr/m²; metres");
    let same = AreaLight { radiance: light.radiance, ..before.clone() };
    if *light == before {
        Change::Nothing
    } else if *light == same {
        Change::Edit(Edit::AreaLights)
    } else {
        Change::Scene
    }
}

fn row(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    ui.label(name);
    contents(ui);
    ui.end_row();
}

fn vector(ui: &mut Ui, v: &mut Vec3) {
    ui.horizontal(|ui| {
        for axis in 0..3 {
            ui.add(DragValue::new(&mut v[axis]).speed(0.01));
        }
    });
}

/// Scene-linear, without an upper end.
fn radiance(ui: &mut Ui, v: &mut Vec3) {
    let speed = 0.01 * v.max_element().max(0.01);
    ui.horizontal(|ui| {
        for axis in 0..3 {
            ui.add(DragValue::new(&mut v[axis]).speed(speed).range(0.0..=1e18));
        }
    });
}

/// Scene-linear numbers, and their colour where they are one.
fn color(ui: &mut Ui, value: &mut [f32; 3], most: f32) {
    ui.horizontal(|ui| {
        if most <= 1.0 {
            ui.color_edit_button_rgb(value);
        }
        for channel in value {
            ui.add(DragValue::new(channel).speed(0.005).range(0.0..=most));
        }
    });
}
