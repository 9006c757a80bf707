//! Other worlds and cameras against the oracle's paths.

use amas::scene::AreaShape;
use glam::{DVec3, Vec3};

use crate::support::{LAMP, MATTE, THINGS, judge, room, scene};

const THREE: &str = "size = [32, 24]\nindirect = { vpls = 2048, bounces = 3 }";

/// The sky shines into the open side, through all orders of reflection.
#[test]
fn background() {
    let render = format!("{THREE}\nbackground = [0.3, 0.5, 0.9]");
    judge("background", scene(&room(&render, MATTE, &[LAMP, THINGS].concat()), &[]), 1000);
}

/// A ball of few facets, whose normals are far from those of its triangles.
#[test]
fn smooth_normals() {
    let things = THINGS.replace("segments = 32", "segments = [7, 4]");
    judge("smooth normals", scene(&room(THREE, MATTE, &[LAMP, &things].concat()), &[]), 1000);
}

#[test]
fn many_triangles() {
    let things = THINGS.replace("segments = 32", "segments = [320, 160]");
    let scene = scene(&room(THREE, MATTE, &[LAMP, &things].concat()), &[]);
    assert!(scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>() >= 100_000);
    judge("many triangles", scene, 1000);
}

/// And a lamp that is seen, and absorbs.
#[test]
fn orthographic_camera() {
    let lamp = LAMP.replace("visible = false\n", "").replace("1.98", "1.7");
    let text = room(THREE, MATTE, &[&lamp, THINGS].concat());
    let text = text.replace("vertical_fov = 42", "orthographic_height = 2.2");
    judge("orthographic", scene(&text, &[]), 1000);
}

/// Some 100 km out, where float32 tells places 8 mm apart.
#[test]
fn far_from_the_origin() {
    let mut scene = scene(&room(THREE, MATTE, &[LAMP, THINGS].concat()), &[]);
    let there = Vec3::new(1e5, 2e4, -1e5);
    for vertex in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices) {
        vertex.position = (Vec3::from(vertex.position) + there).to_array();
    }
    for light in &mut scene.area_lights {
        if let AreaShape::Rect { center, .. } = &mut light.shape {
            *center += there;
        }
    }
    let camera = &mut scene.cameras[0];
    let there: DVec3 = there.as_dvec3();
    camera.position += there;
    camera.target += there;
    judge("far", scene, 1000);
}
