//! Where scenes come from, and what is known of them besides: OBJ files alone, lists of files, progress, cameras as text.

use std::path::Path;

use amas::Scene;
use amas::scene::{Camera, Origin, Projection, load, load_embedded, write};
use glam::{DVec3, Vec3};
use indicatif::ProgressBar;

use crate::{CAMERA, check, png};

/// A slab, 2 × 1 × 4 m, about (10, 0, 0), in other units.
fn slab(folder: &Path, name: &str, scale: f64) -> Scene {
    let mut text = String::new();
    for corner in 0..8 {
        let side = |axis: u32, size: f64| if corner >> axis & 1 == 1 { size / 2.0 } else { -size / 2.0 };
        let [x, y, z] = [10.0 + side(0, 2.0), side(1, 1.0), side(2, 4.0)].map(|x| x * scale);
        text += &format!("v {x} {y} {z}\n");
    }
    text += "f 1 2 4 3\nf 5 6 8 7\nf 1 2 6 5\nf 3 4 8 7\nf 1 3 7 5\nf 2 4 8 6\n";
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    let scene = load(&path, &[("samples".into(), "3".into())]).unwrap();
    check(&scene);
    assert_eq!(scene.render.samples, 3);
    scene
}

/// All of it is in the picture, fills much of it, and is lit the same at any scale.
#[test]
fn an_obj_alone_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    for (name, scale) in [("slab.obj", 1.0), ("a \"slab\" é.OBJ", 1e-3), ("slab.2.obj", 1e4)] {
        let scene = slab(folder.path(), name, scale);
        let [camera] = &scene.cameras[..] else { panic!("one camera") };
        let Projection::Perspective { vertical_fov } = camera.projection else { panic!("perspective") };
        let (basis, edge) = (camera.basis(), (vertical_fov / 2.0).to_radians().tan());
        let mut largest: f64 = 0.0;
        for vertex in scene.meshes.iter().flat_map(|mesh| &mesh.vertices) {
            let way = Vec3::from(vertex.position).as_dvec3() - camera.position;
            let depth = way.dot(basis.forward);
            assert!(depth > camera.near, "{name}: before the near plane");
            largest = largest.max(way.dot(basis.right).abs().max(way.dot(basis.up).abs()) / depth / edge);
        }
        assert!((0.5..1.0).contains(&largest), "{name}: {largest} of the picture's height");
        let middle = Vec3::new(10.0, 0.0, 0.0) * scale as f32;
        let lights = scene.point_lights.iter();
        let irradiance: Vec<f32> =
            lights.map(|light| light.intensity.x / light.position.distance_squared(middle)).collect();
        for (got, want) in irradiance.iter().zip([3.0, 1.0, 2.0]) {
            assert!((got / want - 1.0).abs() < 1e-4, "{name}: {irradiance:?}");
        }
    }
}

#[test]
fn every_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    put("m.obj", b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
    put("m.mtl", b"newmtl a\nmap_Kd color.png\n");
    put("color.png", &png(1, 1, |_, _| [255; 4]));
    put("lights.csv", b"x,y,z,r,g,b\n0,0,0,1,1,1\n");
    let light = "[[light]]\ntype = \"points\"\nfile = \"lights.csv\"\n";
    put("scene.toml", format!("{CAMERA}[[mesh]]\nobj = \"m.obj\"\n{light}").as_bytes());
    let scene = load(&folder.path().join("scene.toml"), &[]).unwrap();
    let names = ["scene.toml", "color.png", "lights.csv", "m.mtl", "m.obj"];
    assert_eq!(scene.files, names.map(|name| folder.path().join(name)));
    assert!(load_embedded("t", CAMERA, &[], &[]).unwrap().files.is_empty());
}

#[test]
fn loading_tells_how_far_it_is_and_ends_when_nobody_waits() {
    let shapes = "[[mesh]]\nshape = \"sphere\"\n".repeat(3);
    let light = "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = [1, 1, 1]\n";
    let text = format!("{CAMERA}{shapes}{light}");
    let origin = Origin::Embedded("t", &text, &[]);
    let progress = ProgressBar::with_draw_target(Some(0), indicatif::ProgressDrawTarget::hidden());
    origin.load(&[], &progress).unwrap();
    assert_eq!((progress.position(), progress.length()), (4, Some(4)));
    progress.abandon();
    let error = origin.load(&[], &progress).unwrap_err().to_string();
    assert!(error.contains("cancelled"), "{error}");
    assert_eq!(origin.settings(&[("size".into(), "[7, 5]".into())]).unwrap().size, [7, 5]);
}

/// What is written is read again, to the last bit.
#[test]
fn written_cameras_are_read_again() {
    let camera = Camera {
        name: "a \"camera\" \\ \u{7f}\té".into(),
        position: DVec3::new(0.1, -1e-9, 1.0 / 3.0),
        target: DVec3::new(1e9, 2.0, -3.0),
        up: DVec3::Z,
        projection: Projection::Perspective { vertical_fov: 39.6 },
        near: 0.05,
        far: None,
        path: Vec::new(),
    };
    let projection = Projection::Orthographic { height: 3.5 };
    for camera in [camera.clone(), Camera { projection, far: Some(1e3), ..camera }] {
        let read = load_embedded("t", &write::camera(&camera), &[], &[]).unwrap().cameras;
        assert_eq!(read, [camera]);
    }
}
