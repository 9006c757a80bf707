//! A square under a point light, the smallest scene that shows something.

use amas::reference::{Options, render};
use amas::scene::material::{PARAMETER_COUNT, Value};
use amas::scene::{Camera, Material, Mesh, Model, Parameter, PointLight, Projection, Scene, Vertex};
use glam::{DVec3, vec3};

pub(crate) fn camera(projection: Projection) -> Camera {
    Camera {
        name: "main".into(),
        position: DVec3::new(0.0, 0.0, 2.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection,
        near: 0.05,
        far: None,
        path: vec![],
    }
}

pub(crate) fn perspective() -> Camera {
    camera(Projection::Perspective { vertical_fov: 60.0 })
}

/// A white Lambert square of side 4 at z = 0, facing +z.
pub(crate) fn scene() -> Scene {
    let mut parameters = [Value::default(); PARAMETER_COUNT];
    parameters[Parameter::Color as usize].constant = [0.5, 0.25, 1.0];
    let material = Material {
        name: "white".into(),
        model: Model::Matte,
        parameters,
        squared_roughness: false,
        two_sided: true,
    };
    let vertex = |[x, y]: [f32; 2]| Vertex {
        position: [2.0 * x, 2.0 * y, 0.0],
        normal: [0.0, 0.0, 1.0],
        tangent: [1.0, 0.0, 0.0, 1.0],
        uv: [0.5 * x + 0.5, 0.5 * y + 0.5],
    };
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mesh =
        Mesh { vertices: corners.map(vertex).into(), triangles: vec![[0, 1, 2], [0, 2, 3]], material: 0 };
    let light = PointLight { position: vec3(0.3, 0.2, 1.0), intensity: vec3(1.0, 2.0, 3.0), range: None };
    Scene {
        cameras: vec![perspective()],
        materials: vec![material],
        meshes: vec![mesh],
        point_lights: vec![light],
        ..Scene::default()
    }
}

pub(crate) fn options(size: [u32; 2]) -> Options {
    Options { size, ..Options::of_scene(&scene()) }
}

pub(crate) fn center(scene: &Scene) -> [f32; 3] {
    render(scene, &scene.cameras[0], &options([1, 1])).unwrap().image.pixels[0]
}
