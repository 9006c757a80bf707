//! `animate` of a group of point lights.
//!
//! Where the contract is silent: `{ type = "orbit", center, axis [0, 1, 0], period }` turns the group about an axis, once in
//! `period` seconds; `{ type = "drift", speed, seed [1] }` sends every light its own straight way at `speed` metres a
//! second, thrown back by the walls of the box that holds the group at time 0.

use super::Value;
use crate::error::Result;
use crate::scene::PointLight;
use crate::scene::motion::Course;
use glam::DVec3;

/// Reads the value of `animate` for a group of lights.
pub(super) fn course(value: &Value, lights: &[PointLight]) -> Result<Course> {
    let table = value.table()?;
    let kind = table.require("type", "\"orbit\"")?;
    match kind.string()? {
        "orbit" => {
            table.allow(&["type", "center", "axis", "period"])?;
            Ok(Course::Orbit {
                center: table.require("center", "[0.0, 0.0, 0.0]")?.vec3()?,
                axis: table.get_or("axis", DVec3::Y, Value::direction)?,
                period: table.require("period", "10.0")?.positive()?,
            })
        }
        "drift" => {
            table.allow(&["type", "speed", "seed"])?;
            Ok(Course::Drift {
                speed: table.require("speed", "1.0")?.positive()?,
                seed: table.get_or("seed", 1, |value| value.integer(0..=u32::MAX))?,
                walls: walls(value, lights)?,
            })
        }
        other => Err(kind.unknown(other, ["orbit", "drift"].into_iter())),
    }
}

/// The box that holds the lights.
fn walls(value: &Value, lights: &[PointLight]) -> Result<[DVec3; 2]> {
    let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let walls = lights.iter().fold(start, |[lower, upper], light| {
        let p = light.position.as_dvec3();
        [lower.min(p), upper.max(p)]
    });
    if walls[1].cmpgt(walls[0]).any() {
        return Ok(walls);
    }
    Err(value
        .error("lets lights drift that are all at one place", "use `type = \"orbit\"`, or several lights"))
}
