//! Ray queries against the walk over our own tree: on devices that have both, they see the same.

use std::path::Path;

use amas::Gpu;
use amas::scene;
use amas::shared::RayProbeRow;
use glam::Vec3;

use crate::common::gpu::CheckedGpu;
use crate::hits::found;
use crate::probe::{Random, occluded, random_soup, ray, soup, sphere};

/// Rays from anywhere among triangles to anywhere.
fn rays(random: &mut Random, count: usize) -> Vec<RayProbeRow> {
    (0..count).map(|_| ray(random.place() * 3.0, random.direction(), 0.0, 6.0 * random.number())).collect()
}

#[test]
fn see_what_the_walk_sees() {
    if !Gpu::enumerate().unwrap().iter().any(|info| info.ray_queries) {
        println!("no device has ray queries");
        return;
    }
    let [walk, query] = [false, true].map(CheckedGpu::open_with);
    assert_eq!([&walk, &query].map(|gpu| gpu.has_ray_queries()), [false, true]);
    let mut random = Random(77);
    let soups = [(1, 1.0), (40, 0.8), (3000, 0.2), (30_000, 0.05)];
    let mut scenes: Vec<_> =
        soups.map(|(count, size)| soup(&random_soup(&mut random, count, Vec3::ZERO, 2.0, size))).into();
    // Leaves with masks.
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/default.toml");
    scenes.extend([soup(&[]), soup(&sphere(Vec3::ZERO)), scene::load(&default, &[]).unwrap()]);
    for scene in &scenes {
        let rows = rays(&mut random, 20_000);
        let hidden = [&walk, &query].map(|gpu| occluded(gpu, scene, &rows));
        assert!(hidden[0] == hidden[1], "{} meshes", scene.meshes.len());
        let [walked, asked] = [&walk, &query].map(|gpu| found(gpu, scene, Vec3::ZERO, &rows));
        let other: Vec<_> =
            walked.iter().zip(&asked).filter(|(walked, asked)| walked.triangle != asked.triangle).collect();
        // The driver may leave out one of two that lie in one place.
        assert!(other.len() * 500 <= rows.len(), "{} of {} differ", other.len(), rows.len());
        for (walked, asked) in other {
            let [walked, asked] = [walked, asked].map(|found| found.row.t);
            assert!((walked - asked).abs() <= 1e-5 * walked, "{walked} {asked}");
        }
    }
    walk.finish();
    query.finish();
}
