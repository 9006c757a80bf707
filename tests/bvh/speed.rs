//! What rays take: CPU time a ray of shadow rays and of nearest hits, in a closed box and in an atrium. Not in the suite:
//! `cargo test --release --test bvh speed -- --ignored --nocapture`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amas::Gpu;
use amas::bvh::Bvh;
use amas::gpu::{DescriptorSet, Options, Shader, Specialization, shaders};
use amas::gpu_scene::hits::Hits;
use amas::gpu_scene::occluders::Occluders;
use amas::reference::rays::{CameraRay, Geometry, Ray};
use amas::scene::{self, Scene};
use amas::shared::RayProbeRow;
use glam::{DVec3, Vec3};

use crate::probe::{Random, ray};

const RAYS: usize = 1 << 18;

/// CPU time of the process so far, seconds: of its threads, which the driver keeps.
fn cpu() -> f64 {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap().flatten();
    let nanoseconds = tasks.filter_map(|task| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    });
    nanoseconds.sum::<f64>() * 1e-9
}

struct World {
    name: &'static str,
    scene: Scene,
    /// Rays of a camera inside, pixel by pixel.
    coherent: Vec<RayProbeRow>,
    /// From where they end, to anywhere on the normal's side, in random order of neither.
    random: Vec<RayProbeRow>,
}

fn world(name: &'static str, scene: Scene, eye: Vec3, forward: Vec3) -> World {
    let geometry = Geometry::new(&scene);
    let side = (RAYS as f32).sqrt() as usize;
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let mut random = Random(51);
    let (mut coherent, mut scattered) = (vec![], vec![]);
    for block in 0..RAYS / 64 {
        for lane in 0..64 {
            // Blocks of 8 × 8 pixels, as workgroups take them.
            let (x, y) = (block % (side / 8) * 8 + lane % 8, block / (side / 8) * 8 + lane / 8);
            let [u, v] = [x, y].map(|i| 1.4 * (i as f32 / side as f32 - 0.5));
            let direction = (forward + right * u - up * v).normalize();
            coherent.push(ray(eye, direction, 0.0, 1e4));
            let line = Ray::new(eye.as_dvec3(), direction.as_dvec3().normalize());
            let view = CameraRay { ray: line, t_min: 0.0, t_max: f64::INFINITY };
            let Some(hit) = geometry.closest(&view) else { continue };
            let place = line.origin + hit.t * line.direction;
            let normal: DVec3 = geometry.normal(&hit).normalize();
            let normal = if normal.dot(line.direction) > 0.0 { -normal } else { normal }.as_vec3();
            let to = random.direction();
            let to = if to.dot(normal) < 0.0 { -to } else { to };
            scattered.push(ray(place.as_vec3() + normal * 1e-4, to, 0.0, 1e4));
        }
    }
    World { name, scene, coherent, random: scattered }
}

fn shared() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared")
}

/// Those of the worlds whose files lie beside the checkout.
fn worlds() -> Vec<World> {
    let cornell = shared().join("reference/g_cornell/scene.toml");
    let sponza = shared().join("models/sponza.obj");
    let mut worlds = vec![];
    if let Ok(scene) = scene::load(&cornell, &[]) {
        let camera = scene.cameras[0].clone();
        let forward = (camera.target - camera.position).normalize().as_vec3();
        worlds.push(world("g_cornell", scene, camera.position.as_vec3(), forward));
    }
    if let Ok(scene) = scene::load(&sponza, &[]) {
        let vertices = scene.meshes.iter().flat_map(|mesh| &mesh.vertices);
        let (lower, upper) = vertices.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lower, upper), vertex| {
            let place = Vec3::from(vertex.position);
            (lower.min(place), upper.max(place))
        });
        let eye = lower + (upper - lower) * Vec3::new(0.3, 0.2, 0.5);
        worlds.push(world("sponza", scene, eye, Vec3::new(1.0, 0.1, 0.15).normalize()));
    }
    worlds
}

/// CPU nanoseconds a ray: the median of five runs, each less what a few rays take.
fn nanoseconds(
    gpu: &Arc<Gpu>,
    (shader, specialization): (Shader, &Specialization),
    bind: &dyn Fn(DescriptorSet<'_>),
    rows: &[RayProbeRow],
) -> f64 {
    let seconds = |rows: &[RayProbeRow]| {
        let before = cpu();
        // Room for either's answers.
        amas::probe::run_among::<_, [u32; 2]>(gpu, shader, specialization, bind, rows).unwrap();
        cpu() - before
    };
    let mut figures: Vec<_> =
        (0..5).map(|_| (seconds(rows) - seconds(&rows[..64])) / (rows.len() - 64) as f64 * 1e9).collect();
    figures.sort_by(f64::total_cmp);
    figures[2]
}

#[test]
#[ignore = "a measurement"]
fn cpu_time_of_rays() {
    let gpu = Gpu::open(&Options {
        ray_queries: std::env::var("AMAS_RAY_QUERIES").ok().map(|value| value == "true"),
        ..Options::default()
    })
    .unwrap();
    for World { name, scene, coherent, random } in worlds() {
        let bvh = Bvh::new(&scene, Vec3::ZERO);
        let (occluders, hits) = (Occluders::new(&gpu, &bvh).unwrap(), Hits::new(&gpu, &scene, &bvh).unwrap());
        let bind = |set: DescriptorSet<'_>| {
            occluders.bind(set);
            hits.bind(set);
        };
        // A light anywhere in the scene: where the ray of another one ends.
        let to_lights = |rows: &[RayProbeRow]| -> Vec<RayProbeRow> {
            let geometry = Geometry::new(&scene);
            let end = |row: &RayProbeRow| {
                let ray = crate::hits::double(row);
                let view = CameraRay { ray, t_min: 0.0, t_max: 1e4 };
                geometry.closest(&view).map(|hit| (ray.origin + (hit.t * 0.99) * ray.direction).as_vec3())
            };
            let target = end(&rows[rows.len() / 3]).unwrap();
            let towards = |row: &RayProbeRow| {
                let to = target - Vec3::from(row.origin);
                RayProbeRow { direction: to.normalize().to_array(), t_max: to.length(), ..*row }
            };
            rows.iter().map(towards).collect()
        };
        let masks = Specialization::default().with_all(&occluders.specialization);
        println!("{name}: {} triangles", bvh.triangles().len());
        for (kind, rows) in [("coherent", &coherent), ("random", &random)] {
            let time = |shader, rows: &[RayProbeRow]| nanoseconds(&gpu, (shader, &masks), &bind, rows);
            let shadow = time(shaders::PROBE_BVH_COMP, rows);
            let nearest = time(shaders::PROBE_NEAREST_COMP, rows);
            println!("  {kind} {}: shadow {shadow:.0} ns, nearest {nearest:.0} ns", rows.len());
        }
        let towards = to_lights(&random);
        println!(
            "  to one light: shadow {:.0} ns",
            nanoseconds(&gpu, (shaders::PROBE_BVH_COMP, &masks), &bind, &towards)
        );
    }
}
