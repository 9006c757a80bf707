//! What an OBJ file alone gets, so that it is seen: a camera before it, three lights around it, a grey background.

use std::path::Path;

use glam::{DVec3, Vec3};

use super::write::string;
use super::{Camera, PointLight, Projection, Scene};

/// Degrees of the camera's field of view, from top to bottom.
const FIELD: f64 = 40.0;
/// Where the camera stands, from the middle of the model: a little above, a little to the right.
const VIEW: DVec3 = DVec3::new(0.5, 0.35, 1.0);
/// Radiance behind the model.
const BACKGROUND: f32 = 0.05;
/// Lights: direction from the middle, and irradiance in the middle, W·m⁻²: key, fill and rim.
const LIGHTS: [(Vec3, f32); 3] =
    [(Vec3::new(-0.6, 1.0, 1.0), 3.0), (Vec3::new(1.0, 0.3, 0.6), 1.0), (Vec3::new(0.2, 0.8, -1.0), 2.0)];

/// The scene file around an OBJ file, with a camera to be moved by [`furnish`].
pub(super) fn around(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let background = [BACKGROUND; 3];
    format!(
        "render.background = {background:?}\n\
         [[camera]]\nname = \"model\"\nposition = [0.0, 0.0, 1.0]\ntarget = [0.0, 0.0, 0.0]\nvertical_fov = {FIELD:?}\n\
         [[mesh]]\nobj = {}\n",
        string(&name)
    )
}

/// Places camera and lights by the model's size.
pub(super) fn furnish(scene: &mut Scene) {
    let positions = || scene.meshes.iter().flat_map(|mesh| &mesh.vertices).map(|v| Vec3::from(v.position));
    let [lower, upper] = positions()
        .fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[lower, upper], p| [lower.min(p), upper.max(p)]);
    let middle = (lower.as_dvec3() + upper.as_dvec3()) / 2.0;
    // Of the sphere around it. A model has a triangle with an area, and so a size.
    let radius = (upper.as_dvec3() - lower.as_dvec3()).length() / 2.0;
    let distance = radius / (FIELD / 2.0).to_radians().sin();
    let around = 3.0 * radius as f32;
    for camera in &mut scene.cameras {
        *camera = Camera {
            position: middle + VIEW.normalize() * distance,
            target: middle,
            projection: Projection::Perspective { vertical_fov: FIELD },
            near: distance * 1e-3,
            ..camera.clone()
        };
    }
    let light = |(direction, irradiance): (Vec3, f32)| PointLight {
        position: middle.as_vec3() + direction.normalize() * around,
        intensity: Vec3::splat(irradiance * around * around),
        range: None,
    };
    scene.point_lights.extend(LIGHTS.map(light));
}
