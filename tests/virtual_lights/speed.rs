//! Not of the suite: how long it takes, on one thread, `cargo test --release --test virtual_lights speed -- --ignored
//! --nocapture`.

use std::path::Path;
use std::time::Instant;

use amas::scene::load;
use amas::virtual_lights::{Tracer, VirtualTree};
use glam::Vec3;

#[test]
#[ignore = "measures, and asserts nothing; AMAS_SCENES lists scene files"]
fn speed() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let files = std::env::var("AMAS_SCENES").unwrap_or_default();
    for file in files.split(':').filter(|file| !file.is_empty()) {
        let scene = load(Path::new(file), &[]).unwrap();
        let tracer = pool.install(|| Tracer::new(&scene, Vec3::ZERO));
        let mut rows = vec![];
        for seed in 0..5 {
            let begin = cpu_time::ProcessTime::now();
            let wall = Instant::now();
            let set = pool.install(|| tracer.trace(1 << 18, seed));
            rows.push((set.bounced.len(), wall.elapsed(), begin.elapsed()));
        }
        println!("{file}: {rows:?}");
        let set = pool.install(|| tracer.trace(1 << 20, 7));
        let begin = cpu_time::ProcessTime::now();
        let tree = pool.install(|| VirtualTree::new(&set.bounced));
        println!("tree over {}: {:?}", tree.lights.len(), begin.elapsed());
    }
}
