//! The tables of a scene's file, and the values in them that are set.

use super::{Row, rows};
use crate::scene::light::AreaLight;
use crate::scene::settings::Tonemap;
use crate::scene::{AreaShape, Material, Parameter, PointLight, RenderSettings};
use toml_edit::{Array, DocumentMut, InlineTable, Item as Entry, TableLike, Value};

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

pub(super) fn set_render(table: &mut dyn TableLike, old: &RenderSettings, now: &RenderSettings) {
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

pub(super) fn set_material(document: &mut DocumentMut, old: &Material, now: &Material) -> Result<(), String> {
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

pub(super) fn set_point(
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

pub(super) fn set_area(
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
