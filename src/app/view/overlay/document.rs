//! A scene's file with what was changed in the window: everything else, comments too, stays as it is.

use super::picked::{Item, Picked};
use crate::error::{Error, Result};
use crate::image::write_atomically;
use crate::scene::light::AreaLight;
use crate::scene::settings::Tonemap;
use crate::scene::{AreaShape, Material, Model, Parameter, PointLight, RenderSettings, Scene};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use toml_edit::{Array, DocumentMut, InlineTable, Item as Entry, TableLike, Value};

/// A parameter that a model has: its key, how many numbers, and their upper end.
pub(super) struct Row {
    pub(super) parameter: Parameter,
    pub(super) key: &'static str,
    pub(super) channels: usize,
    pub(super) most: f32,
}

/// The parameters of a material that can be changed.
pub(super) fn rows(material: &Material) -> Vec<Row> {
    use Parameter as P;
    let row = |parameter, key, channels, most| Row { parameter, key, channels, most };
    let roughness = row(P::Roughness, if material.squared_roughness { "roughness" } else { "alpha" }, 1, 1.0);
    let (diffuse, specular) = (row(P::Color, "diffuse", 3, 1.0), row(P::Specular, "specular", 3, 1.0));
    let scalar = |parameter, key| row(parameter, key, 1, 1.0);
    match material.model {
        Model::Matte => vec![row(P::Color, "color", 3, 1.0), row(P::Sigma, "sigma", 1, 90.0)],
        Model::Plastic => vec![diffuse, specular, roughness],
        Model::Substrate => vec![diffuse, specular, roughness],
        Model::Metal => vec![row(P::Color, "eta", 3, 10.0), row(P::Specular, "k", 3, 20.0), roughness],
        Model::Principled => vec![
            row(P::Color, "base_color", 3, 1.0),
            scalar(P::Metallic, "metallic"),
            roughness,
            scalar(P::SpecularTint, "specular_tint"),
            scalar(P::Sheen, "sheen"),
            scalar(P::SheenTint, "sheen_tint"),
            scalar(P::Clearcoat, "clearcoat"),
            scalar(P::ClearcoatGloss, "clearcoat_gloss"),
            scalar(P::Subsurface, "subsurface"),
        ],
    }
}

/// Writes the scene of file `original` with its changes to `target`; what could not be written, as sentences.
pub(super) fn save(
    original: &Path,
    target: &Path,
    scene: &Scene,
    render: &RenderSettings,
    before: &BTreeMap<Picked, Item>,
) -> Result<Vec<String>> {
    if original.parent() != target.parent() {
        return Err(Error::usage(
            format!("{}: the files that the scene names lie beside {}", target.display(), original.display()),
            "save it in the same folder",
        ));
    }
    let text = std::fs::read_to_string(original).map_err(|error| {
        Error::input(original, None, format!("cannot read the scene: {error}"), "check the file")
    })?;
    let (text, left_out) = edited(&text, scene, render, before)
        .map_err(|cause| Error::input(original, None, cause, "check the file"))?;
    write_atomically(target, |file| file.write_all(text.as_bytes()))?;
    Ok(left_out)
}

/// The text with its changes, and sentences on what could not be changed in it.
fn edited(
    text: &str,
    scene: &Scene,
    render: &RenderSettings,
    before: &BTreeMap<Picked, Item>,
) -> Result<(String, Vec<String>), String> {
    let mut document: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
    let mut left_out = Vec::new();
    if render != &scene.render {
        let table = document.entry("render").or_insert_with(toml_edit::table);
        let table = table.as_table_like_mut().ok_or("render is no table")?;
        set_render(table, render, &scene.render);
    }
    for (&picked, old) in before {
        let now = picked.of(scene);
        let done = match (picked, old, &now) {
            (Picked::Material(_), Item::Material(old), Some(Item::Material(now))) => {
                set_material(&mut document, old, now)
            }
            (Picked::Point(index), _, Some(Item::Point(now))) => {
                set_point(&mut document, &scene.point_groups, index, now)
            }
            (Picked::Area(index), Item::Area(old), Some(Item::Area(now))) => {
                set_area(&mut document, index, old, now)
            }
            _ => Ok(()),
        };
        left_out.extend(done.err());
    }
    Ok((document.to_string(), left_out))
}

/// The tables of a list, written as `[[name]]` or in line.
fn tables<'a>(document: &'a mut DocumentMut, name: &str) -> Vec<&'a mut dyn TableLike> {
    match document.get_mut(name) {
        Some(Entry::ArrayOfTables(tables)) => tables.iter_mut().map(|t| t as &mut dyn TableLike).collect(),
        Some(Entry::Value(Value::Array(array))) => {
            let tables = array.iter_mut().filter_map(Value::as_inline_table_mut);
            tables.map(|table| table as &mut dyn TableLike).collect()
        }
        _ => Vec::new(),
    }
}

/// Sets a key; the space and comment around an old value stay.
fn set(table: &mut dyn TableLike, key: &str, value: impl Into<Value>) {
    let mut value = value.into();
    if let Some(old) = table.get(key).and_then(Entry::as_value) {
        *value.decor_mut() = old.decor().clone();
    }
    match table.get_mut(key) {
        Some(entry) => *entry = Entry::Value(value),
        None => {
            table.insert(key, Entry::Value(value));
        }
    }
}

/// The shortest decimal that is read as this number again.
fn number(x: f32) -> f64 {
    x.to_string().parse().unwrap_or_else(|_| x.into())
}

fn numbers(values: &[f32]) -> Array {
    values.iter().map(|&x| number(x)).collect()
}

fn set_render(table: &mut dyn TableLike, old: &RenderSettings, now: &RenderSettings) {
    if old.exposure != now.exposure {
        set(table, "exposure", number(now.exposure));
    }
    if old.samples != now.samples {
        set(table, "samples", i64::from(now.samples));
    }
    if old.tonemap != now.tonemap {
        let name = match now.tonemap {
            Tonemap::None => "none",
            Tonemap::Aces => "aces",
            Tonemap::Agx => "agx",
        };
        set(table, "tonemap", name);
    }
    if old.light_error != now.light_error {
        set(table, "light_error", number(now.light_error));
    }
    if old.max_lights_per_cluster != now.max_lights_per_cluster {
        set(table, "max_lights_per_cluster", i64::from(now.max_lights_per_cluster));
    }
    if old.shadows != now.shadows {
        set(table, "shadows", now.shadows);
    }
    if (old.vpls, old.bounces) != (now.vpls, now.bounces) {
        let indirect = table.entry("indirect").or_insert(Entry::Value(InlineTable::new().into()));
        if let Some(indirect) = indirect.as_table_like_mut() {
            set(indirect, "vpls", i64::from(now.vpls));
            set(indirect, "bounces", i64::from(now.bounces));
        }
    }
}

fn set_material(document: &mut DocumentMut, old: &Material, now: &Material) -> Result<(), String> {
    let mut materials = tables(document, "material").into_iter();
    let named = |table: &&mut dyn TableLike| table.get("name").and_then(Entry::as_str) == Some(&now.name);
    let Some(table) = materials.find(named) else {
        return Err(format!("Material {:?} is of an MTL file, and stays as it is there.", now.name));
    };
    let preset = table.remove("preset").is_some();
    for Row { parameter, key, channels, .. } in rows(now) {
        let value = now.value(parameter);
        let of_preset = preset && ["eta", "k"].contains(&key);
        if value.texture.is_some() || value == old.value(parameter) && !of_preset {
            continue;
        }
        if key == "alpha" && table.get(key).is_some_and(|entry| entry.is_array()) {
            let (alpha, aspect) = (value.constant[0], now.value(Parameter::Aspect).constant[0]);
            set(table, key, numbers(&[alpha / aspect, alpha * aspect]));
        } else if channels == 3 {
            set(table, key, numbers(&value.constant));
        } else {
            set(table, key, number(value.constant[0]));
        }
    }
    if old.two_sided != now.two_sided {
        set(table, "two_sided", now.two_sided);
    }
    Ok(())
}

fn set_point(
    document: &mut DocumentMut,
    groups: &[std::ops::Range<usize>],
    index: usize,
    now: &PointLight,
) -> Result<(), String> {
    let kind = |table: &&mut dyn TableLike, kinds: &[&str]| {
        table.get("type").and_then(Entry::as_str).is_some_and(|kind| kinds.contains(&kind))
    };
    let mut entries = tables(document, "light").into_iter().filter(|t| kind(t, &["point", "points"]));
    let group = groups.iter().position(|group| group.contains(&index));
    let table = group.and_then(|group| entries.nth(group)).filter(|table| kind(table, &["point"]));
    let Some(table) = table else {
        return Err(format!("Point light {index} is one of a group, and stays as it is there."));
    };
    set(table, "position", numbers(&now.position.to_array()));
    set(table, "intensity", numbers(&now.intensity.to_array()));
    match now.range {
        Some(range) => set(table, "range", number(range)),
        None => {
            table.remove("range");
        }
    }
    Ok(())
}

fn set_area(
    document: &mut DocumentMut,
    index: usize,
    old: &AreaLight,
    now: &AreaLight,
) -> Result<(), String> {
    let shapes = ["polygon", "rect", "disk", "line"];
    let is_area = |table: &&mut dyn TableLike| {
        table.get("type").and_then(Entry::as_str).is_some_and(|kind| shapes.contains(&kind))
    };
    let Some(table) = tables(document, "light").into_iter().filter(is_area).nth(index) else {
        return Err(format!("Area light {index} is not in the file any more."));
    };
    if old.radiance != now.radiance {
        set(table, "radiance", numbers(&now.radiance.to_array()));
    }
    if old.two_sided != now.two_sided {
        set(table, "two_sided", now.two_sided);
    }
    if old.visible != now.visible {
        set(table, "visible", now.visible);
    }
    if old.shape != now.shape {
        match &now.shape {
            AreaShape::Rect { center, .. } | AreaShape::Disk { center, .. } => {
                set(table, "center", numbers(&center.to_array()));
            }
            AreaShape::Line { a, b, .. } => {
                set(table, "a", numbers(&a.to_array()));
                set(table, "b", numbers(&b.to_array()));
            }
            AreaShape::Polygon { .. } => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"# A hall.
[render]
size = [8, 8]   # small
exposure = 1.5  # bright

[[camera]]
name = "main"
position = [0, 1, 4]
target = [0, 1, 0]
vertical_fov = 45

[[material]]
name = "gold"
type = "metal"
preset = "gold" # as mined
roughness = 0.3

[[material]]
name = "floor"
type = "matte"
color = [0.5, 0.5, 0.5] # grey

[[mesh]]
shape = "plane"
size = [4, 4]
material = "floor"

[[light]]
type = "points"
generate = { count = 3, min = [0, 0, 0], max = [1, 1, 1], intensity = [1, 2] }

[[light]]
type = "point"
position = [0, 2, 0]
intensity = [1, 1, 1] # white
range = 5.0

[[light]]
type = "disk"
center = [0, 3, 0]
normal = [0, -1, 0]
radius = 0.5
radiance = [4, 4, 4]
"#;

    /// What is saved is loaded as it was in the window, and the rest of the file has not changed.
    #[test]
    fn changes_survive_and_comments_stay() {
        let folder = tempfile::tempdir().unwrap();
        let [original, target] = ["hall.toml", "edited.toml"].map(|name| folder.path().join(name));
        std::fs::write(&original, TEXT).unwrap();
        let mut scene = crate::scene::load(&original, &[]).unwrap();
        let render = scene.render.clone();
        let picks =
            [Picked::Material(0), Picked::Material(1), Picked::Point(1), Picked::Point(3), Picked::Area(0)];
        let before: BTreeMap<_, _> = picks.map(|picked| (picked, picked.of(&scene).unwrap())).into();
        scene.render.exposure = -0.7;
        scene.render.shadows = true;
        (scene.render.vpls, scene.render.bounces) = (4096, 2);
        scene.materials[0].parameters[Parameter::Color as usize].constant[1] = 0.1;
        scene.materials[1].parameters[Parameter::Color as usize].constant = [0.1, 0.2, 0.3];
        scene.materials[1].two_sided = false;
        scene.point_lights[3].position.x = 0.1;
        scene.point_lights[3].range = None;
        scene.area_lights[0].radiance.z = 7.25;
        let left_out = save(&original, &target, &scene, &render, &before).unwrap();
        assert_eq!(left_out, ["Point light 1 is one of a group, and stays as it is there."]);
        let saved = crate::scene::load(&target, &[]).unwrap();
        assert_eq!(saved.render, scene.render);
        assert_eq!(saved.materials, scene.materials);
        assert_eq!(saved.point_lights, scene.point_lights);
        assert_eq!(saved.area_lights, scene.area_lights);
        let text = std::fs::read_to_string(&target).unwrap();
        for kept in ["# A hall.", "size = [8, 8]   # small", "exposure = -0.7  # bright", "# grey", "# white"]
        {
            assert!(text.contains(kept), "{kept} is not in: {text}");
        }
        assert!(!text.contains("preset"), "{text}");
        // Nothing changed, nothing written.
        let same = edited(TEXT, &crate::scene::load(&original, &[]).unwrap(), &render, &BTreeMap::new());
        assert_eq!(same, Ok((TEXT.into(), Vec::new())));
    }

    #[test]
    fn scenes_stay_beside_what_they_name() {
        let scene = Scene::default();
        let saved = save(Path::new("a/b.toml"), Path::new("c.toml"), &scene, &scene.render, &BTreeMap::new());
        assert!(saved.is_err_and(|error| error.to_string().contains("same folder")));
    }
}
