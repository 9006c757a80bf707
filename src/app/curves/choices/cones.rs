//! How many of the pairs of pixel and light, the light in reach, have it behind the surface: the most that clusters split by
//! normals could leave out.

use crate::app::default_scene;
use crate::error::Result;
use crate::reference::rays::{Geometry, camera_ray};
use crate::reference::shading::Surface;
use crate::scene::{Scene, load_embedded};
use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

const GRID: &str = include_str!("../../../../scenes/light_grid.toml");
const GRID_LIGHTS: (&str, &[u8]) =
    ("light_grid_4096.csv", include_bytes!("../../../../scenes/light_grid_4096.csv"));

/// A scene's pairs.
#[derive(Serialize)]
pub(super) struct Behind {
    pub(super) scene: &'static str,
    /// Lights within whose range a pixel is, in the mean over the pixels.
    pub(super) per_pixel: f64,
    /// Share of them that lie below the surface's horizon.
    pub(super) behind: f64,
}

/// Of two scenes, pictures of this size.
pub(super) fn measure(size: [u32; 2]) -> Result<Vec<Behind>> {
    let grid = load_embedded("light_grid.toml", GRID, &[GRID_LIGHTS], &[])?;
    let default = load_embedded("default.toml", default_scene::TOML, default_scene::FILES, &[])?;
    Ok(vec![count("scenes/light_grid.toml", &grid, size), count("scenes/default.toml", &default, size)])
}

fn count(name: &'static str, scene: &Scene, size: [u32; 2]) -> Behind {
    let geometry = Geometry::new(scene);
    let [width, height] = size;
    let pixel = |index: u32| {
        let [x, y] = [index % width, index / width].map(|at| f64::from(at) + 0.5);
        let view = camera_ray(&scene.cameras[0], size, x, y);
        let Some(hit) = geometry.closest(&view) else { return [0; 2] };
        pairs(scene, &Surface::new(scene, &view.ray, &hit))
    };
    let sum = |a: [u64; 2], b: [u64; 2]| [a[0] + b[0], a[1] + b[1]];
    let [near, behind] = (0..width * height).into_par_iter().map(pixel).reduce(|| [0; 2], sum);
    Behind {
        scene: name,
        per_pixel: near as f64 / f64::from(width * height),
        behind: behind as f64 / near.max(1) as f64,
    }
}

/// Lights in reach of a surface, and those of them below its horizon.
fn pairs(scene: &Scene, surface: &Surface) -> [u64; 2] {
    let offset = |position: glam::Vec3| -> DVec3 { position.as_dvec3() - surface.position };
    let near = scene
        .point_lights
        .iter()
        .filter(|light| light.range.is_none_or(|range| offset(light.position).length() < f64::from(range)));
    near.fold([0; 2], |[near, behind], light| {
        let below = offset(light.position).dot(surface.frame.normal) <= 0.0;
        [near + 1, behind + u64::from(below)]
    })
}
