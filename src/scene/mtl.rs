//! MTL files and the rule that makes them our materials.
//!
//! | the MTL has | model | parameters |
//! | --- | --- | --- |
//! | any of `Pr Pm Pc Pcr Ps aniso map_Pr map_Pm` | principled | base_color = `Kd`, roughness = `Pr` (default 0.5), metallic = `Pm` (default 0), clearcoat = `Pc` (default 0), clearcoat_gloss = 1 − `Pcr`, sheen = `Ps` (default 0), anisotropic = `aniso` (default 0), eta = `Ni` |
//! | else `illum` 0 or 1, or `Ks` below 0.001 without `map_Ks` | matte | color = `Kd` |
//! | else | plastic | diffuse = `Kd`, specular = `Ks`, eta = `Ni`, alpha = √(2/(`Ns` + 2)) |
//!
//! `Kd` defaults to 0.5, `Ns` to 10, and an `Ni` of at most 1 counts as 1.5. `map_Kd`, `map_Ks`, `map_Pr` and
//! `map_Pm` replace their constants; `norm`, else `map_bump` or `bump`, is the normal map (a grey picture is a
//! height map, of strength `-bm`); `map_d` is the alpha mask. Keywords are read in any case. Emission, transparency
//! and texture transforms are not supported and reported.

use std::collections::HashMap;
use std::path::Path;

use super::decode::{Fault, Use};
use super::load::Loader;
use super::material::{Material, Model, Parameter};
use super::obj_scan::logical_lines;
use crate::error::{Error, Result};

/// A specular colour below this is none.
const NO_SPECULAR: f32 = 1e-3;

/// Statements of one number, and of one colour.
const NUMBERS: [&str; 11] = ["ns", "ni", "d", "tr", "illum", "pr", "pm", "pc", "pcr", "ps", "aniso"];
const COLORS: [&str; 3] = ["kd", "ks", "ke"];
const MAPS: [&str; 8] = ["map_kd", "map_ks", "map_pr", "map_pm", "map_d", "norm", "map_bump", "bump"];

/// A `newmtl` as it stands in the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Entry {
    pub(super) name: String,
    /// Of its `newmtl`, from 1.
    pub(super) line: usize,
    /// By lower-case keyword; numbers fill all three.
    values: HashMap<&'static str, [f32; 3]>,
    maps: HashMap<&'static str, Map>,
}

#[derive(Clone, Debug, PartialEq)]
struct Map {
    file: String,
    /// `-bm`.
    strength: f32,
    /// `-s`, `-o` or `-t` was given.
    transformed: bool,
}

/// Reads the text of an MTL file; `file` is for messages.
///
/// # Errors
/// [`Error::Input`] with the line of a statement that is not a number where it must be one.
pub(super) fn read(file: &Path, text: &str) -> Result<Vec<Entry>> {
    let mut entries: Vec<Entry> = Vec::new();
    for (number, line) in logical_lines(text.trim_start_matches('\u{feff}')) {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((&line, ""));
        let (keyword, rest) = (keyword.to_ascii_lowercase(), rest.trim());
        if keyword == "newmtl" {
            entries.push(Entry { name: rest.to_owned(), line: number, ..Entry::default() });
        } else if let Some(entry) = entries.last_mut() {
            statement(entry, &keyword, rest).map_err(|cause| {
                Error::input(file, number, cause, "correct the line, or export the material again")
            })?;
        }
    }
    Ok(entries)
}

fn statement(entry: &mut Entry, keyword: &str, rest: &str) -> Result<(), String> {
    let known = |list: &[&'static str]| list.iter().copied().find(|known| *known == keyword);
    if let Some(key) = known(&NUMBERS).or_else(|| known(&COLORS)) {
        // `d -halo 0.5`; and spectral curves, which nobody writes.
        let tokens = rest.split_whitespace().filter(|token| *token != "-halo");
        let tokens = tokens.take_while(|token| !token.starts_with('#')).take(3);
        if ["spectral", "xyz"].contains(&rest.split_whitespace().next().unwrap_or_default()) {
            return Ok(());
        }
        let number = |token: &str| token.parse::<f32>().ok().filter(|x| x.abs() <= 1e18);
        let numbers: Option<Vec<f32>> = tokens.map(number).collect();
        let value = match numbers.as_deref() {
            Some([x, y, z]) if COLORS.contains(&key) => [x.max(0.0), y.max(0.0), z.max(0.0)],
            Some([x, ..]) => [x.max(0.0); 3],
            _ => {
                return Err(format!("`{keyword}` needs a finite number, but has \"{rest}\""));
            }
        };
        entry.values.insert(key, value);
    } else if let Some(key) = known(&MAPS) {
        entry.maps.insert(key, map(rest).ok_or_else(|| format!("`{keyword}` names no file"))?);
    }
    Ok(())
}

/// `[-option values]… file name, perhaps with spaces`.
fn map(rest: &str) -> Option<Map> {
    let mut map = Map { file: String::new(), strength: 1.0, transformed: false };
    let mut rest = rest;
    while rest.starts_with('-') {
        let (option, tail) = word(rest);
        let most = match option {
            "-o" | "-s" | "-t" => 3,
            "-mm" => 2,
            "-bm" | "-boost" | "-texres" | "-clamp" | "-blendu" | "-blendv" | "-cc" | "-imfchan"
            | "-type" => 1,
            _ => break,
        };
        map.transformed |= most == 3;
        rest = tail;
        for _ in 0..most {
            let (value, tail) = word(rest);
            let number = value.parse::<f32>().ok();
            if most > 1 && number.is_none() {
                break;
            }
            if option == "-bm" {
                map.strength = number?.clamp(-100.0, 100.0);
            }
            rest = tail;
        }
    }
    map.file = rest.to_owned();
    (!rest.is_empty()).then_some(map)
}

fn word(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim_start())
}

/// The material that `entry` of the MTL file at `path` stands for.
///
/// # Errors
/// [`Error::Input`] if one of its textures is there but cannot be decoded.
pub(super) fn material(loader: &mut Loader, path: &str, entry: &Entry, name: String) -> Result<Material> {
    let mut material = Material {
        name,
        model: model(entry),
        parameters: Default::default(),
        squared_roughness: false,
        two_sided: true,
    };
    constants(entry, &mut material);
    let bump = entry.maps.get("map_bump").or_else(|| entry.maps.get("bump"));
    let normal = entry.maps.get("norm").or(bump);
    let mut wanted = vec![
        (entry.maps.get("map_kd"), Parameter::Color, Use::Color),
        (entry.maps.get("map_d"), Parameter::Mask, Use::Mask),
        (normal, Parameter::Normal, Use::Normal(normal.map_or(0, |map| (map.strength * 1000.0) as i32))),
    ];
    match material.model {
        Model::Plastic => wanted.push((entry.maps.get("map_ks"), Parameter::Specular, Use::Color)),
        Model::Principled => {
            wanted.push((entry.maps.get("map_pr"), Parameter::Roughness, Use::Scalar));
            wanted.push((entry.maps.get("map_pm"), Parameter::Metallic, Use::Scalar));
        }
        _ => {}
    }
    for (map, parameter, usage) in wanted {
        let Some(map) = map else { continue };
        let texture = texture(loader, path, entry, map, usage)?;
        material.parameters[parameter as usize].texture = texture;
    }
    report(loader, path, entry);
    Ok(material)
}

fn model(entry: &Entry) -> Model {
    let pbr = ["pr", "pm", "pc", "pcr", "ps", "aniso"].iter().any(|key| entry.values.contains_key(key));
    if pbr || entry.maps.contains_key("map_pr") || entry.maps.contains_key("map_pm") {
        return Model::Principled;
    }
    let diffuse_only = entry.values.get("illum").is_some_and(|illum| illum[0] < 2.0);
    let specular = entry.values.get("ks").is_some_and(|ks| ks.iter().any(|x| *x >= NO_SPECULAR));
    if diffuse_only || !(specular || entry.maps.contains_key("map_ks")) {
        Model::Matte
    } else {
        Model::Plastic
    }
}

fn constants(entry: &Entry, material: &mut Material) {
    let color = |key: &str, default: f32| entry.values.get(key).copied().unwrap_or([default; 3]);
    let unit = |key: &str, default: f32| color(key, default)[0].min(1.0);
    let eta = Some(color("ni", 1.5)[0]).filter(|eta| *eta > 1.0).map_or(1.5, |eta| eta.min(100.0));
    let mut set =
        |parameter: Parameter, constant| material.parameters[parameter as usize].constant = constant;
    let scalar = |x: f32| [x, 0.0, 0.0];
    set(Parameter::Color, color("kd", 0.5));
    match material.model {
        Model::Plastic => {
            set(Parameter::Specular, color("ks", 1.0));
            set(Parameter::Eta, scalar(eta));
            set(Parameter::Roughness, scalar((2.0 / (color("ns", 10.0)[0] + 2.0)).sqrt()));
            set(Parameter::Aspect, scalar(1.0));
        }
        Model::Principled => {
            set(Parameter::Eta, scalar(eta));
            set(Parameter::Roughness, scalar(unit("pr", 0.5)));
            set(Parameter::Aspect, scalar((1.0 - 0.9 * unit("aniso", 0.0)).sqrt()));
            set(Parameter::Metallic, scalar(unit("pm", 0.0)));
            set(Parameter::Sheen, scalar(unit("ps", 0.0)));
            set(Parameter::SheenTint, scalar(0.5));
            set(Parameter::Clearcoat, scalar(unit("pc", 0.0)));
            set(Parameter::ClearcoatGloss, scalar(1.0 - unit("pcr", 0.0)));
            material.squared_roughness = true;
        }
        _ => {}
    }
}

/// The texture of `map`; a file that is not there is a warning, since MTL files often travel without them.
fn texture(loader: &mut Loader, path: &str, entry: &Entry, map: &Map, usage: Use) -> Result<Option<u32>> {
    let (place, name) = (place(loader, path, entry), &entry.name);
    if map.transformed {
        let cause = format!("material \"{name}\": -s, -o and -t of the texture \"{}\" are ignored", map.file);
        loader.warn(&place, cause, "move the mesh's texture coordinates instead");
    }
    let Some(file) = loader.files.find_nearby(path, &map.file) else {
        let cause =
            format!("material \"{name}\": the texture \"{}\" is missing; the constant is used", map.file);
        loader.warn(&place, cause, "put the file there, or give a [[material]] of that name");
        return Ok(None);
    };
    let index = loader.textures.load(&file, usage, &place).map_err(|Fault { cause, remedy }| {
        let cause = format!("material \"{name}\" names \"{file}\": {cause}");
        Error::input(loader.files.display(path), entry.line, cause, remedy)
    })?;
    Ok(Some(index))
}

/// File and line of an entry, for messages.
pub(super) fn place(loader: &Loader, path: &str, entry: &Entry) -> String {
    format!("{}:{}", loader.files.display(path).display(), entry.line)
}

fn report(loader: &mut Loader, path: &str, entry: &Entry) {
    let value = |key: &str| entry.values.get(key).map(|value| value[0]);
    let (place, name) = (place(loader, path, entry), &entry.name);
    if entry.values.get("ke").is_some_and(|ke| ke.iter().any(|x| *x > 0.0)) {
        let cause = format!("material \"{name}\": emission (Ke) is ignored");
        loader.warn(&place, cause, "add an area light where the mesh is");
    }
    if value("d").is_some_and(|d| d < 1.0) || value("tr").is_some_and(|tr| tr > 0.0) {
        let cause = format!("material \"{name}\": transparency (d, Tr) is ignored; the surface is opaque");
        loader.warn(&place, cause, "cut it out with map_d, or leave the mesh out");
    }
}
