//! `[[light]]`: the sorts, point lights, and lights by the thousand.
//!
//! Where the contract is silent: `visible = true` on a point light is an error, since a point has no surface
//! to be seen; a generator's `seed` defaults to 1 and lies within 32 bits.

use super::{Table, Value, area, motion};
use crate::error::{Error, Result};
use crate::scene::Motion;
use crate::scene::light::PointLight;
use crate::scene::load::Loader;
use crate::scene::points::{self, Generator};
use crate::shared::MAX_AREA_LIGHTS;

/// Most lights of a scene, area lights included.
const MOST_LIGHTS: usize = 1 << 20;

/// Reads every `[[light]]` into the loader's scene.
pub(in crate::scene) fn lights(loader: &mut Loader, root: &Table) -> Result<()> {
    for table in root.tables("light")? {
        loader.advance()?;
        let kind = table.require("type", "\"point\"")?;
        match kind.string()? {
            "point" => group(loader, &table, vec![point(&table)?])?,
            "points" => group(loader, &table, many(loader, &table)?)?,
            shape @ ("polygon" | "rect" | "disk" | "line") => {
                let light = area::light(loader, &table, shape)?;
                loader.scene.area_lights.push(light);
                if loader.scene.area_lights.len() > MAX_AREA_LIGHTS as usize {
                    let cause =
                        format!("with this one the scene has more than {MAX_AREA_LIGHTS} area lights");
                    return Err(table.error(cause, "use fewer, or point lights for the smallest of them"));
                }
            }
            other => {
                let known = ["point", "points", "polygon", "rect", "disk", "line"];
                return Err(kind.unknown(other, known.into_iter()));
            }
        }
        let count = loader.scene.point_lights.len() + loader.scene.area_lights.len();
        if count > MOST_LIGHTS {
            let cause = format!("with this one the scene has {count} lights, more than {MOST_LIGHTS}");
            return Err(table.error(cause, "use fewer lights"));
        }
    }
    Ok(())
}

/// Adds point lights that belong together, and how they move.
fn group(loader: &mut Loader, table: &Table, lights: Vec<PointLight>) -> Result<()> {
    let scene = &mut loader.scene;
    let first = scene.point_lights.len();
    if let Some(animate) = table.get("animate") {
        let course = motion::course(&animate, &lights)?;
        scene.motions.push(Motion { lights: first..first + lights.len(), course });
    }
    scene.point_groups.push(first..first + lights.len());
    scene.point_lights.extend(lights);
    Ok(())
}

fn point(table: &Table) -> Result<PointLight> {
    table.allow(&["type", "position", "intensity", "range", "visible", "animate"])?;
    refuse_visible(table)?;
    Ok(PointLight {
        position: table.require("position", "[0.0, 2.0, 0.0]")?.vec3()?.as_vec3(),
        intensity: table.require("intensity", "[10.0, 10.0, 10.0]")?.color()?.into(),
        range: range(table)?,
    })
}

fn refuse_visible(table: &Table) -> Result<()> {
    match table.get("visible") {
        Some(value) if value.boolean()? => Err(value
            .error("is true, but a point has no surface to see", "use a small disk or leave the key out")),
        _ => Ok(()),
    }
}

fn range(table: &Table) -> Result<Option<f32>> {
    table.get("range").map(|value| Ok(value.positive()? as f32)).transpose()
}

fn many(loader: &Loader, table: &Table) -> Result<Vec<PointLight>> {
    table.allow(&["type", "file", "generate", "visible", "animate"])?;
    refuse_visible(table)?;
    match (table.get("file"), table.get("generate")) {
        (Some(file), None) => from_file(loader, &file),
        (None, Some(generate)) => Ok(generator(&generate)?.lights()),
        (Some(_), Some(generate)) => Err(generate.error("stands beside `file`", "keep one of the two")),
        (None, None) => Err(table.error(
            "the light has neither `file` nor `generate`",
            "add `file = \"lights.csv\"` or `generate = { count = 1000, min = [0, 0, 0], max = [1, 1, 1], intensity = [1, 1] }`",
        )),
    }
}

fn from_file(loader: &Loader, value: &Value) -> Result<Vec<PointLight>> {
    let path = loader.find(value)?;
    let bytes = loader.read(&path)?;
    let shown = loader.files.display(&path);
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        Error::input(
            &shown,
            None,
            format!("the file is not UTF-8 text: {error}"),
            "save it as plain CSV in UTF-8",
        )
    })?;
    let lights = points::read_csv(&shown, text.trim_start_matches('\u{feff}'))?;
    if lights.is_empty() {
        return Err(Error::input(&shown, None, "the file has no lights", "add lines below the header"));
    }
    Ok(lights)
}

fn generator(value: &Value) -> Result<Generator> {
    let table = value.table()?;
    table.allow(&["count", "seed", "min", "max", "intensity", "range"])?;
    let min = table.require("min", "[-1.0, 0.0, -1.0]")?.vec3()?;
    let max_value = table.require("max", "[1.0, 1.0, 1.0]")?;
    let max = max_value.vec3()?;
    if min.cmpgt(max).any() {
        return Err(
            max_value.error("lies below `min`", "let every coordinate of `max` be at least that of `min`")
        );
    }
    let intensity = table.require("intensity", "[1.0, 2.0]")?;
    let [low, high] = intensity.array("[1.0, 2.0]")?;
    let rule = "0 or more";
    let (low, high) = (low.number_where(|x| x >= 0.0, rule)?, high.number_where(|x| x >= 0.0, rule)?);
    if low > high {
        return Err(intensity.error("has lo > hi", "write [lo, hi] with lo ≤ hi"));
    }
    Ok(Generator {
        count: table.require("count", "1000")?.integer(1..=MOST_LIGHTS as u32)?,
        seed: table.get_or("seed", 1, |value| value.integer(0..=u32::MAX))?,
        min,
        max,
        intensity: low..=high,
        range: range(&table)?,
    })
}
