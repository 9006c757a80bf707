//! Real models, where they lie beside the repository; their like in small, always.

use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::{CAMERA, check, obj};

fn shared() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared")
}

/// Loads a model of the shared folder; `None` where the folder is missing.
fn model(file: &str, keys: &str) -> Option<amas::Scene> {
    let path = shared().join("models").join(file);
    if !path.exists() {
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("s.toml");
    let path = path.canonicalize().unwrap();
    std::fs::write(&scene, format!("{CAMERA}[[mesh]]\nobj = '{}'\n{keys}\n", path.display())).unwrap();
    let scene = amas::scene::load(&scene, &[]).unwrap();
    check(&scene);
    Some(scene)
}

fn triangles(scene: &amas::Scene) -> usize {
    scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
}

#[test]
fn a_small_model_without_mtl_loads_like_the_large_ones() {
    let mesh = obj("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\nf 1 4 2\n", "");
    assert_eq!(mesh.triangles.len(), 2);
}

#[test]
fn sponza() {
    a_small_model_without_mtl_loads_like_the_large_ones();
    let Some(scene) = model("sponza.obj", "scale = 0.01") else {
        return;
    };
    assert!((33_000..=33_663).contains(&triangles(&scene)), "{}", triangles(&scene));
    assert!(scene.warnings.iter().any(|w| w.contains("sponza.mtl")), "{:?}", scene.warnings);
}

#[test]
fn samurai_monastery() {
    a_small_model_without_mtl_loads_like_the_large_ones();
    let start = Instant::now();
    let Some(scene) = model("samurai_monastry.obj", "") else {
        return;
    };
    let seconds = start.elapsed().as_secs_f64();
    // 0.3 s on an idle core.
    println!("{seconds:.3} s, {} triangles, {:?}", triangles(&scene), scene.warnings);
    assert!((120_000..=125_500).contains(&triangles(&scene)), "{}", triangles(&scene));
    assert!(scene.materials.len() <= 82);
}

#[test]
fn spot_bunny_and_teapot() {
    a_small_model_without_mtl_loads_like_the_large_ones();
    for (file, count) in [("spot.obj", 5_856), ("stanford-bunny.obj", 69_451), ("teapot.obj", 6_320)] {
        let Some(scene) = model(file, "") else { return };
        let found = triangles(&scene);
        assert!(found <= count && found * 100 >= count * 98, "{file}: {found}");
    }
}

#[test]
fn the_reference_scenes_load() {
    a_small_model_without_mtl_loads_like_the_large_ones();
    for name in ["a_rect_metal", "b_rect_plastic", "d_disk_mixed", "f_points64", "g_cornell"] {
        let path = shared().join("reference").join(name).join("scene.toml");
        if !path.exists() {
            return;
        }
        let scene = amas::scene::load(&path, &[]).unwrap();
        check(&scene);
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        assert_eq!(scene.render.size, [320, 240]);
    }
}
