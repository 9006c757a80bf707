//! `[render]` and its overrides from the command line.
//!
//! Ranges where the contract is silent: `size` 1…16384 a side and 67,108,864 pixels in all, `exposure` −64…64,
//! `samples` 1…65536, `light_error` 0…1, `indirect.vpls` 0…1,048,576, `indirect.bounces` 0…64.

use std::path::Path;

use toml::de::DeValue;

use super::{Source, Table, Value, suggestion};
use crate::error::{Error, Result};
use crate::scene::settings::{FrontEnd, RenderSettings, Tonemap};

/// Pixels of the largest picture: 1 GiB as float32 RGBA.
const LARGEST_PICTURE: u32 = 1 << 26;

const KEYS: [&str; 10] = [
    "size",
    "exposure",
    "samples",
    "tonemap",
    "background",
    "light_error",
    "max_lights_per_cluster",
    "indirect",
    "shadows",
    "front_end",
];

const INDIRECT_KEYS: [&str; 2] = ["vpls", "bounces"];

/// Reads `[render]`; what it leaves out keeps its default.
pub(in crate::scene) fn settings(root: &Table) -> Result<RenderSettings> {
    let mut settings = RenderSettings::default();
    let Some(value) = root.get("render") else {
        return Ok(settings);
    };
    let table = value.named_table("[render]")?;
    table.allow(&KEYS)?;
    for value in table.values() {
        apply(&mut settings, &value)?;
    }
    Ok(settings)
}

/// Applies `--set KEY=VALUE`: a key of `[render]`, with or without `render.`, and a TOML value; a bare word is
/// a string.
pub(in crate::scene) fn set(
    settings: &mut RenderSettings,
    path: &Path,
    key: &str,
    value: &str,
) -> Result<()> {
    let pair = format!("{key}={value}");
    let name = key.trim();
    let name = name.strip_prefix("render.").unwrap_or(name);
    let known = KEYS.into_iter().chain(["indirect.vpls", "indirect.bounces"]);
    if !known.clone().any(|known| known == name) {
        let cause = format!("--set {pair}: unknown key `{name}` in [render]");
        return Err(Error::usage(cause, suggestion(name, known)));
    }
    let text = quoted(value.trim());
    let source = Source::set(path, &text, &pair);
    let parsed = DeValue::parse(&text).map_err(|error| source.syntax(&error))?;
    apply(settings, &source.value(name, &parsed))
}

/// A bare word becomes a string; everything else stays as it is.
fn quoted(value: &str) -> String {
    let word = value.starts_with(|c: char| c.is_ascii_alphabetic())
        && value.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let literal = ["true", "false", "inf", "nan"].contains(&value);
    if word && !literal { format!("\"{value}\"") } else { value.to_owned() }
}

/// One key; `value.key()` is one of [`KEYS`] or a dotted key below `indirect`.
fn apply(settings: &mut RenderSettings, value: &Value) -> Result<()> {
    match value.key() {
        "size" => settings.size = size(value)?,
        "exposure" => settings.exposure = value.within(-64.0..=64.0)? as f32,
        "samples" => settings.samples = value.integer(1..=65536)?,
        "tonemap" => settings.tonemap = tonemap(value)?,
        "background" => settings.background = value.color()?,
        "light_error" => settings.light_error = value.within(0.0..=1.0)? as f32,
        "max_lights_per_cluster" => settings.max_lights_per_cluster = value.integer(128..=2048)?,
        "indirect" => indirect(settings, value)?,
        "indirect.vpls" | "vpls" => settings.vpls = value.integer(0..=1 << 20)?,
        "indirect.bounces" | "bounces" => settings.bounces = value.integer(0..=64)?,
        "front_end" => settings.front_end = front_end(value)?,
        _ => settings.shadows = value.boolean()?,
    }
    Ok(())
}

fn size(value: &Value) -> Result<[u32; 2]> {
    let [width, height] = value.array("[1280, 720]")?;
    let size = [width.integer(1..=16384)?, height.integer(1..=16384)?];
    if size[0] * size[1] > LARGEST_PICTURE {
        let cause = format!("is {} × {}, more than {LARGEST_PICTURE} pixels", size[0], size[1]);
        return Err(value.error(cause, "choose a smaller picture"));
    }
    Ok(size)
}

fn tonemap(value: &Value) -> Result<Tonemap> {
    value.choice(&[("none", Tonemap::None), ("aces", Tonemap::Aces), ("agx", Tonemap::Agx)])
}

fn front_end(value: &Value) -> Result<FrontEnd> {
    let names = [("auto", FrontEnd::Auto), ("fragment", FrontEnd::Fragment), ("compute", FrontEnd::Compute)];
    value.choice(&names)
}

fn indirect(settings: &mut RenderSettings, value: &Value) -> Result<()> {
    if !value.is_table() {
        let cause = "must be a table of `vpls` and `bounces`";
        return Err(value.error(cause, "did you mean `indirect.vpls`, the number of virtual lights?"));
    }
    let table = value.table()?;
    table.allow(&INDIRECT_KEYS)?;
    table.values().try_for_each(|value| apply(settings, &value))
}
