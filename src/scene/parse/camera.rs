//! `[[camera]]`.
//!
//! Where the contract is silent: a camera without a `name` is called `camera N` by its place in the file;
//! exactly one of `vertical_fov` and `orthographic_height` must be given.

use glam::DVec3;

use super::{Table, Value};
use crate::error::Result;
use crate::scene::camera::{Camera, KeyFrame, Projection};

/// Sine of the angle between view and `up` below which the camera has no usable frame.
const PARALLEL: f64 = 1e-6;

/// All cameras of the document; at least one.
pub(in crate::scene) fn cameras(root: &Table) -> Result<Vec<Camera>> {
    let mut cameras: Vec<Camera> = Vec::new();
    for table in root.tables("camera")? {
        let camera = camera(&table, cameras.len() + 1)?;
        if cameras.iter().any(|other| other.name == camera.name) {
            return Err(
                table.error(format!("two cameras are named \"{}\"", camera.name), "give each its own name")
            );
        }
        cameras.push(camera);
    }
    if cameras.is_empty() {
        let remedy = "add [[camera]] with position = [0, 1, 5], target = [0, 1, 0] and vertical_fov = 45.0";
        return Err(root.error("the scene has no camera", remedy));
    }
    Ok(cameras)
}

fn camera(table: &Table, number: usize) -> Result<Camera> {
    table.allow(&[
        "name",
        "position",
        "target",
        "up",
        "vertical_fov",
        "orthographic_height",
        "near",
        "far",
        "path",
    ])?;
    let name = table.get_or("name", format!("camera {number}"), |value| Ok(value.string()?.to_owned()))?;
    let position = table.require("position", "[0.0, 1.0, 5.0]")?.vec3()?;
    let target = table.require("target", "[0.0, 1.0, 0.0]")?;
    let up = table.get_or("up", DVec3::Y, Value::direction)?;
    let near = table.get_or("near", 0.05, Value::positive)?;
    check_view(&target, position, target.vec3()?, up)?;
    Ok(Camera {
        name,
        position,
        target: target.vec3()?,
        up,
        projection: projection(table)?,
        near,
        far: far(table, near)?,
        path: table.get_or("path", Vec::new(), |value| path(value, up))?,
    })
}

fn projection(table: &Table) -> Result<Projection> {
    match (table.get("vertical_fov"), table.get("orthographic_height")) {
        (Some(fov), None) => {
            let rule = "between 0 and 180 degrees";
            let vertical_fov = fov.number_where(|x| x > 0.0 && x < 180.0, rule)?;
            Ok(Projection::Perspective { vertical_fov })
        }
        (None, Some(height)) => Ok(Projection::Orthographic { height: height.positive()? }),
        (Some(_), Some(height)) => {
            Err(height
                .error("stands beside `vertical_fov`", "keep one of the two: perspective or orthographic"))
        }
        (None, None) => Err(table.error(
            "the camera has neither `vertical_fov` nor `orthographic_height`",
            "add `vertical_fov = 45.0` (degrees) or `orthographic_height = 10.0` (metres)",
        )),
    }
}

fn far(table: &Table, near: f64) -> Result<Option<f64>> {
    let Some(value) = table.get("far") else {
        return Ok(None);
    };
    let rule = format!("greater than near = {near}");
    value.number_where(|far| far > near, &rule).map(Some)
}

/// Refuses a view without direction or along `up`.
fn check_view(at: &Value, position: DVec3, target: DVec3, up: DVec3) -> Result<()> {
    let Some(forward) = (target - position).try_normalize() else {
        return Err(at.error("is the camera's own position", "move `position` or `target`"));
    };
    if forward.cross(up).length() < PARALLEL {
        return Err(
            at.error("lies along `up`", "choose an `up` across the view, e.g. [0, 0, -1] when looking down")
        );
    }
    Ok(())
}

fn path(value: &Value, up: DVec3) -> Result<Vec<KeyFrame>> {
    let mut keys: Vec<KeyFrame> = Vec::new();
    for item in value.items("[ { t = 0.0, position = [0, 1, 4], target = [0, 1, 0] } ]")? {
        let key = key_frame(&item, up)?;
        if let Some(last) = keys.last() {
            check_segment(&item, last, &key, up)?;
        }
        keys.push(key);
    }
    Ok(keys)
}

fn key_frame(item: &Value, up: DVec3) -> Result<KeyFrame> {
    let table = item.table()?;
    table.allow(&["t", "position", "target"])?;
    let t = table.require("t", "0.0")?.number()?;
    let position = table.require("position", "[0.0, 1.0, 4.0]")?.vec3()?;
    let target = table.require("target", "[0.0, 1.0, 0.0]")?;
    check_view(&target, position, target.vec3()?, up)?;
    Ok(KeyFrame { t, position, target: target.vec3()? })
}

/// Times ascend, and nowhere between the two keys does the view vanish or run along `up`.
fn check_segment(item: &Value, a: &KeyFrame, b: &KeyFrame, up: DVec3) -> Result<()> {
    if b.t <= a.t {
        let cause = format!("has t = {} after t = {}", b.t, a.t);
        return Err(item.error(cause, "give the key frames in ascending time"));
    }
    // view × up is linear in time, as the view is: its smallest length is that of a segment from the origin.
    let from = (a.target - a.position).cross(up);
    let step = (b.target - b.position).cross(up) - from;
    let s = (-from.dot(step) / step.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    if (from + step * s).length() < PARALLEL * from.length() {
        let cause = "passes through a view along `up` on the way from the key before";
        return Err(item.error(cause, "add a key frame between the two that leads the view around"));
    }
    Ok(())
}
