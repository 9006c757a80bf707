//! The scene loader: known answers, bad input, and input that is noise.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod bad;
mod bad_files;
mod bad_sections;
mod format;
mod fuzz;
mod lights;
mod materials;
mod meshes;
mod models;
mod motion;
mod obj;
mod origin;
mod textures;

use std::io::Cursor;

use amas::scene::{Mesh, Scene, load_embedded};

/// The least that every scene needs.
const CAMERA: &str = "[[camera]]\nposition = [0, 1, 5]\ntarget = [0, 1, 0]\nvertical_fov = 45.0\n";

/// Loads `CAMERA` and `toml`.
fn try_load(toml: &str, files: &[(&str, &[u8])], set: &[(&str, &str)]) -> amas::Result<Scene> {
    let set: Vec<_> = set.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    load_embedded("test.toml", &format!("{CAMERA}{toml}"), files, &set)
}

/// Whatever loading warns of has a place and a remedy.
fn load(toml: &str, files: &[(&str, &[u8])]) -> Scene {
    let scene = try_load(toml, files, &[]).unwrap();
    for warning in &scene.warnings {
        let place = warning.split_once(": ").and_then(|(place, _)| place.rsplit_once(':'));
        assert!(place.is_some_and(|(_, line)| line.parse::<u32>().is_ok_and(|line| line > 0)), "{warning}");
        assert!(warning.split_once("\n  remedy: ").is_some_and(|(_, remedy)| remedy.len() > 5), "{warning}");
    }
    scene
}

/// The one mesh of an OBJ, with further keys of its `[[mesh]]`.
fn obj(text: &str, keys: &str) -> Mesh {
    let scene = load(&format!("[[mesh]]\nobj = \"m.obj\"\n{keys}"), &[("m.obj", text.as_bytes())]);
    assert_eq!(scene.meshes.len(), 1, "one material, one mesh");
    scene.meshes.into_iter().next().unwrap()
}

fn png(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let picture = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y)));
    let mut bytes = Vec::new();
    picture.write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    bytes
}

fn close(a: &[f32], b: &[f32]) {
    let near = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
    assert!(near, "{a:?} is not {b:?}");
}

/// Index, normals, and tangents in order: what every loaded mesh must hold.
fn check(scene: &Scene) {
    for mesh in &scene.meshes {
        assert!((mesh.material as usize) < scene.materials.len());
        assert!(!mesh.triangles.is_empty());
        for index in mesh.triangles.as_flattened() {
            assert!((*index as usize) < mesh.vertices.len());
        }
        for vertex in &mesh.vertices {
            let length = |v: &[f32]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
            assert!((length(&vertex.normal) - 1.0).abs() < 1e-4, "{vertex:?}");
            let [x, y, z, w] = vertex.tangent;
            let tangent = length(&[x, y, z]);
            assert!(vertex.tangent == [0.0; 4] || (tangent - 1.0).abs() < 1e-4, "{vertex:?}");
            assert!(w == 0.0 || w.abs() == 1.0, "{vertex:?}");
            let dot: f32 = vertex.normal.iter().zip([x, y, z]).map(|(n, t)| n * t).sum();
            assert!(dot.abs() < 1e-4, "{vertex:?}");
            assert!(vertex.position.iter().chain(&vertex.uv).all(|x| x.is_finite()));
        }
    }
}
