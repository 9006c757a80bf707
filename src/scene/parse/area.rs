//! Area lights: `type = "polygon"`, `"rect"`, `"disk"` and `"line"`.
//!
//! Where the contract is silent: `visible` defaults to true and `two_sided` to false; a disk given by its
//! `normal` has its u axis horizontal, along (0, 1, 0) × normal (or +X where the normal is vertical), which
//! matters for its texture only; a line takes no texture, and `two_sided` means nothing to it.

use glam::{DVec3, Vec3};

use super::{Table, Value};
use crate::error::Result;
use crate::scene::decode::{Fault, Use};
use crate::scene::light::{AreaLight, AreaShape};
use crate::scene::load::Loader;
use crate::scene::outline;

/// Sine of the angle between two half axes below which they count as parallel.
const PARALLEL: f64 = 1e-6;
/// Most holes of a polygon.
const MOST_HOLES: usize = 64;

/// The area light in `table`, of the sort `shape`.
pub(super) fn light(loader: &mut Loader, table: &Table, shape: &str) -> Result<AreaLight> {
    let own: &[&str] = match shape {
        "polygon" => &["vertices", "holes", "uvs", "texture"],
        "rect" => &["center", "u", "v", "texture"],
        "disk" => &["center", "u", "v", "normal", "radius", "texture"],
        _ => &["a", "b", "radius"],
    };
    table.allow(&[own, &["type", "radiance", "two_sided", "visible"]].concat())?;
    let mut shape = match shape {
        "polygon" => polygon(table)?,
        "rect" => {
            let (center, u, v) = axes(table)?;
            AreaShape::Rect { center, u, v }
        }
        "disk" => disk(table)?,
        _ => line(loader, table)?,
    };
    let texture = texture(loader, table, &mut shape)?;
    Ok(AreaLight {
        shape,
        radiance: table.require("radiance", "[20.0, 20.0, 20.0]")?.color()?.into(),
        two_sided: table.get_or("two_sided", false, Value::boolean)?,
        visible: table.get_or("visible", true, Value::boolean)?,
        texture,
    })
}

/// The texture, with as much of its border as a polygon's coordinates reach beyond it, where these then lie.
fn texture(loader: &mut Loader, table: &Table, shape: &mut AreaShape) -> Result<Option<u32>> {
    let Some(value) = table.get("texture") else {
        return Ok(None);
    };
    let index = loader.texture(&value, Use::Color)?;
    match (shape, table.get("uvs")) {
        (AreaShape::Polygon { uvs: Some(uvs), .. }, Some(value)) => {
            let reached = loader.textures.reach(index, uvs);
            reached.map(Some).map_err(|Fault { cause, remedy }| value.error(cause, remedy))
        }
        _ => Ok(Some(index)),
    }
}

/// `center`, `u` and `v`, with u × v ≠ 0.
fn axes(table: &Table) -> Result<(Vec3, Vec3, Vec3)> {
    let center = table.require("center", "[0.0, 2.0, 0.0]")?.vec3()?;
    let u = table.require("u", "[0.5, 0.0, 0.0]")?.vec3()?;
    let v_value = table.require("v", "[0.0, 0.0, 0.5]")?;
    let v = v_value.vec3()?;
    let rounded = (u.as_vec3().as_dvec3(), v.as_vec3().as_dvec3());
    if rounded.0.cross(rounded.1).length() <= PARALLEL * rounded.0.length() * rounded.1.length() {
        let cause = "is parallel to `u`, or one of them is zero";
        return Err(v_value.error(cause, "give two half axes that span an area"));
    }
    Ok((center.as_vec3(), u.as_vec3(), v.as_vec3()))
}

fn disk(table: &Table) -> Result<AreaShape> {
    let Some(normal) = table.get("normal") else {
        if let Some(radius) = table.get("radius") {
            return Err(radius.error("stands without `normal`", "add `normal`, or use `u` and `v` alone"));
        }
        let (center, u, v) = axes(table)?;
        return Ok(AreaShape::Disk { center, u, v });
    };
    if let Some(axis) = table.get("u").or_else(|| table.get("v")) {
        return Err(axis.error("stands beside `normal`", "keep `normal` and `radius`, or `u` and `v`"));
    }
    let center = table.require("center", "[0.0, 2.0, 0.0]")?.vec3()?.as_vec3();
    let radius = table.require("radius", "0.5")?.positive()?;
    let normal = normal.direction()?;
    let u = DVec3::Y.cross(normal).try_normalize().unwrap_or(DVec3::X);
    let v = normal.cross(u);
    Ok(AreaShape::Disk { center, u: (u * radius).as_vec3(), v: (v * radius).as_vec3() })
}

fn line(loader: &mut Loader, table: &Table) -> Result<AreaShape> {
    let a = table.require("a", "[-1.0, 2.0, 0.0]")?.vec3()?.as_vec3();
    let end = table.require("b", "[1.0, 2.0, 0.0]")?;
    let b = end.vec3()?.as_vec3();
    if a == b {
        return Err(end.error("is the same point as `a`", "give the line two different ends"));
    }
    let value = table.require("radius", "0.02")?;
    let radius = value.positive()? as f32;
    let length = (b.as_dvec3() - a.as_dvec3()).length();
    if f64::from(radius) > length {
        let cause = format!(
            "the line is thicker, {radius} m in radius, than its {length} m of length: on surfaces nearer to its axis than 3 \
             radii its light may be 4 % off, and more"
        );
        loader.warn(&value.place(), cause, "make it thinner, or use a disk or rectangles");
    }
    Ok(AreaShape::Line { a, b, radius })
}

fn polygon(table: &Table) -> Result<AreaShape> {
    let value = table.require("vertices", "[[0, 2, 0], [0, 2, 1], [1, 2, 0]]")?;
    let vertices = outline_loop(&value)?;
    let plane = outline::Plane::new(&vertices).map_err(|cause| value.error(cause, outline::REMEDY))?;
    let mut holes: Vec<Vec<DVec3>> = Vec::new();
    if let Some(value) = table.get("holes") {
        let items = value.items("[[[0, 2, 0], [0, 2, 1], [1, 2, 0]]]")?;
        if items.len() > MOST_HOLES {
            return Err(
                value.error(format!("has {} holes", items.len()), format!("use at most {MOST_HOLES}"))
            );
        }
        for item in items {
            // A single hole without brackets of its own.
            if item.items("").is_ok_and(|points| points.first().is_some_and(|point| !point.is_array())) {
                let remedy = "put each hole into brackets: `holes = [[[0, 2, 0], [0, 2, 1], [1, 2, 0]]]`";
                return Err(item.error("is a point, but must be an array of points", remedy));
            }
            let hole = outline_loop(&item)?;
            let apart = plane
                .check_hole(&vertices, &hole)
                .and_then(|()| holes.iter().try_for_each(|other| plane.check_apart(other, &hole)));
            apart.map_err(|cause| item.error(cause, outline::REMEDY))?;
            holes.push(hole);
        }
    }
    let uvs = table.get("uvs").map(|value| uvs(&value, vertices.len())).transpose()?;
    let round = |points: Vec<DVec3>| points.into_iter().map(|point| point.as_vec3()).collect();
    Ok(AreaShape::Polygon { vertices: round(vertices), holes: holes.into_iter().map(round).collect(), uvs })
}

/// 3 to 64 points.
fn outline_loop(value: &Value) -> Result<Vec<DVec3>> {
    let items = value.items("[[0, 2, 0], [0, 2, 1], [1, 2, 0]]")?;
    if !(3..=64).contains(&items.len()) {
        return Err(value.error(format!("has {} vertices", items.len()), "give 3 to 64 vertices"));
    }
    items.iter().map(Value::vec3).collect()
}

fn uvs(value: &Value, count: usize) -> Result<Vec<[f32; 2]>> {
    let items = value.items("[[0, 0], [1, 0], [1, 1]]")?;
    if items.len() != count {
        let cause = format!("has {} entries for {count} vertices", items.len());
        return Err(value.error(cause, "give one [u, v] per outer vertex"));
    }
    let pair = |item: &Value| {
        let [u, v] = item.array("[0.0, 1.0]")?;
        Ok([u.number()? as f32, v.number()? as f32])
    };
    items.iter().map(pair).collect()
}
