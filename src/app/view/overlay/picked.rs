//! What of the scene lies under the pointer.

use crate::app::view::picture::Picture;
use crate::error::Result;
use crate::scene::{AreaShape, Camera, Luminaire, Material, PointLight, Projection, Scene, light::AreaLight};
use glam::{DVec2, DVec3, Vec3};

/// How near a light has to be to the pointer, in pixels.
const REACH: f64 = 12.0;

/// A part of the scene, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::app::view) enum Picked {
    Material(usize),
    Point(usize),
    Area(usize),
}

/// What it is.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app::view) enum Item {
    Material(Box<Material>),
    Point(PointLight),
    Area(AreaLight),
}

impl Picked {
    /// `None` where the scene, which may have been loaded anew, has no such part.
    pub(in crate::app::view) fn of(self, scene: &Scene) -> Option<Item> {
        match self {
            Self::Material(index) => {
                scene.materials.get(index).cloned().map(|it| Item::Material(Box::new(it)))
            }
            Self::Point(index) => scene.point_lights.get(index).copied().map(Item::Point),
            Self::Area(index) => scene.area_lights.get(index).cloned().map(Item::Area),
        }
    }

    /// Where it is, if it is a light.
    pub(super) fn place(self, scene: &Scene) -> Option<Vec3> {
        match self.of(scene)? {
            Item::Material(_) => None,
            Item::Point(light) => Some(light.position),
            Item::Area(light) => Some(middle(&light.shape)),
        }
    }
}

/// What is under a pixel: a point light near it that no surface hides, else the surface's material or the light that is
/// seen there, else an area light that is not seen.
pub(super) fn pick(picture: &Picture, camera: &Camera, time: f64, at: [f64; 2]) -> Result<Option<Picked>> {
    let (scene, size) = (&picture.scene, picture.frame.settings().size);
    let pixel = [0, 1].map(|axis| (at[axis].max(0.0) as u32).min(size[axis] - 1));
    let surface = picture.frame.position_at(pixel)?;
    let depth = surface.map_or(f64::INFINITY, |p| (p - camera.position).dot(camera.basis().forward));
    let points = scene.point_lights_at(time);
    let near = nearest(points.iter().map(|light| light.position), camera, size, at, 1.01 * depth);
    if let Some(index) = near {
        return Ok(Some(Picked::Point(index)));
    }
    match (picture.frame.material_at(pixel)?, surface) {
        (Some(Some(material)), _) => return Ok(Some(Picked::Material(material as usize))),
        (Some(None), Some(p)) => return Ok(seen(&scene.area_lights, p.as_vec3()).map(Picked::Area)),
        _ => {}
    }
    let middles = scene.area_lights.iter().map(|light| middle(&light.shape));
    Ok(nearest(middles, camera, size, at, f64::INFINITY).map(Picked::Area))
}

/// Index of the place nearest to a pixel, within reach and not farther than `depth` metres.
fn nearest(
    places: impl Iterator<Item = Vec3>,
    camera: &Camera,
    size: [u32; 2],
    at: [f64; 2],
    depth: f64,
) -> Option<usize> {
    let far = |place: Vec3| {
        let [x, y, z] = project(camera, size, place.as_dvec3())?;
        (z <= depth).then_some(DVec2::new(x, y).distance(at.into()))
    };
    let reached = places.enumerate().filter_map(|(index, place)| Some((index, far(place)?)));
    let nearest = reached.filter(|(_, far)| *far <= REACH).min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map(|(index, _)| index)
}

/// Pixel coordinates and depth of a place; `None` behind the camera.
pub(super) fn project(camera: &Camera, size: [u32; 2], place: DVec3) -> Option<[f64; 3]> {
    let (basis, way) = (camera.basis(), place - camera.position);
    let [width, height] = size.map(f64::from);
    let depth = way.dot(basis.forward);
    // Half the picture's height, metres, at that depth.
    let half = match camera.projection {
        Projection::Perspective { vertical_fov } => depth * (0.5 * vertical_fov.to_radians()).tan(),
        Projection::Orthographic { height } => 0.5 * height,
    };
    let scale = 0.5 * height / half;
    let x = 0.5 * width + scale * way.dot(basis.right);
    let y = 0.5 * height - scale * way.dot(basis.up);
    (depth > camera.near).then_some([x, y, depth])
}

fn middle(shape: &AreaShape) -> Vec3 {
    match shape {
        AreaShape::Rect { center, .. } | AreaShape::Disk { center, .. } => *center,
        AreaShape::Line { a, b, .. } => 0.5 * (*a + *b),
        AreaShape::Polygon { vertices, .. } => vertices.iter().sum::<Vec3>() / vertices.len().max(1) as f32,
    }
}

/// The visible light whose surface is nearest to a place.
fn seen(lights: &[AreaLight], place: Vec3) -> Option<usize> {
    let far = |light: &AreaLight| {
        let surface = Luminaire::new(light);
        let corner = |index: u32| Vec3::from(surface.vertices[index as usize].position);
        surface.triangles.iter().map(|t| distance(place, t.map(corner))).fold(f32::INFINITY, f32::min)
    };
    let visible = lights.iter().enumerate().filter(|(_, light)| light.visible);
    let nearest = visible.map(|(i, light)| (i, far(light))).min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map(|(index, _)| index)
}

/// From a point to a triangle: to its plane above the inside, else to the nearest edge.
fn distance(p: Vec3, corners: [Vec3; 3]) -> f32 {
    let edges = [0, 1, 2].map(|i| (corners[i], corners[(i + 1) % 3]));
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
    if normal != Vec3::ZERO && edges.iter().all(|&(a, b)| (b - a).cross(p - a).dot(normal) >= 0.0) {
        return (p - corners[0]).dot(normal).abs();
    }
    let to_edge = |&(a, b): &(Vec3, Vec3)| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        p.distance(a + t * (b - a))
    };
    edges.iter().map(to_edge).fold(f32::INFINITY, f32::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_to_a_triangle() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let cases = [
            (Vec3::new(0.2, 0.2, -3.0), 3.0),
            (Vec3::new(-3.0, 0.0, 4.0), 5.0),
            (Vec3::new(0.5, -2.0, 0.0), 2.0),
            (Vec3::new(1.0, 1.0, 0.0), 0.5_f32.sqrt()),
        ];
        for (p, expected) in cases {
            assert!((distance(p, corners) - expected).abs() < 1e-6, "{p}");
        }
    }

    #[test]
    fn places_are_found_where_the_contract_draws_them() {
        let mut camera = crate::app::view::pilot::tests::camera();
        // 90° high, so 1 m up at 2 m is half of the upper half: pixel rows from the top.
        let place = DVec3::new(1.0, 1.0, -2.0);
        let lands = |camera: &Camera| {
            let [x, y, z] = project(camera, [200, 100], place).unwrap();
            assert!(DVec3::new(x, y, z).distance(DVec3::new(125.0, 25.0, 2.0)) < 1e-9, "{x} {y} {z}");
        };
        lands(&camera);
        assert_eq!(project(&camera, [200, 100], -place), None);
        camera.projection = Projection::Orthographic { height: 4.0 };
        lands(&camera);
        let places = [place.as_vec3(), Vec3::new(0.0, 0.0, -1.0)];
        let at = |at, depth| nearest(places.into_iter(), &camera, [200, 100], at, depth);
        assert_eq!(at([120.0, 28.0], 9.0), Some(0));
        assert_eq!(at([120.0, 28.0], 1.5), None);
        assert_eq!(at([100.0, 50.0], 9.0), Some(1));
        assert_eq!(at([10.0, 10.0], 9.0), None);
    }
}
