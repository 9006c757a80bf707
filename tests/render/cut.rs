//! Lights without a range through the cuts of their tree, against brute force.

use crate::support::{FIVE_MATERIALS, Rig, scene};
use amas::HdrImage;
use amas::Scene;
use amas::scene::PointLight;
use amas::shared::NO_CLUSTER;
use glam::Vec3;

/// The generator of `scene::points`.
struct Lcg(u32);

impl Lcg {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / 16_777_216.0
    }

    fn within(&mut self, lower: [f32; 3], upper: [f32; 3]) -> Vec3 {
        let (lower, upper) = (Vec3::from(lower), Vec3::from(upper));
        lower + (upper - lower) * Vec3::new(self.next(), self.next(), self.next())
    }

    fn color(&mut self) -> Vec3 {
        Vec3::new(0.2 + 0.8 * self.next(), 0.2 + 0.8 * self.next(), 0.2 + 0.8 * self.next())
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Uniform,
    AlongSurfaces,
    OneDominant,
    OnePoint,
    BeyondFar,
    HalfBehind,
    TenDecades,
}

const KINDS: [Kind; 7] = [
    Kind::Uniform,
    Kind::AlongSurfaces,
    Kind::OneDominant,
    Kind::OnePoint,
    Kind::BeyondFar,
    Kind::HalfBehind,
    Kind::TenDecades,
];

/// Lights around [`FIVE_MATERIALS`].
fn lights(kind: Kind, count: usize) -> Vec<PointLight> {
    let mut rng = Lcg(kind as u32 + 1);
    let sphere = |rng: &mut Lcg, i: usize| {
        let around = rng.within([-1.0; 3], [1.0; 3]).normalize_or(Vec3::Y) * (0.42 + 0.08 * rng.next());
        let place = around + Vec3::new((i % 5) as f32 * 0.75 - 1.5, 0.4, 0.0);
        place.max(Vec3::new(-9.0, 0.01, -9.0))
    };
    let mut lights: Vec<_> = (0..count)
        .map(|i| {
            let position = match kind {
                Kind::AlongSurfaces if i % 2 == 0 => sphere(&mut rng, i),
                Kind::AlongSurfaces => rng.within([-4.0, 0.02, -4.0], [4.0, 0.1, 4.0]),
                Kind::OnePoint => Vec3::new(0.5, 1.2, 1.0),
                Kind::BeyondFar => rng.within([-50.0, 0.0, -200.0], [50.0, 50.0, -100.0]),
                Kind::HalfBehind => rng.within([-10.0, -2.0, -10.0], [10.0, 6.0, 20.0]),
                _ => rng.within([-4.0, 0.02, -4.0], [4.0, 3.0, 4.0]),
            };
            let scale = match kind {
                Kind::TenDecades => 10_f32.powf(10.0 * rng.next() - 5.0),
                _ => 0.1 + 0.9 * rng.next(),
            };
            PointLight { position, intensity: rng.color() * scale, range: None }
        })
        .collect();
    if kind == Kind::OneDominant {
        let sum: Vec3 = lights.iter().map(|light| light.intensity).sum();
        lights[0] = PointLight {
            position: Vec3::new(2.0, 2.5, 2.0),
            intensity: sum * Vec3::new(1.0, 0.8, 0.6),
            range: None,
        };
    }
    lights
}

fn world(text: &str, lights: Vec<PointLight>) -> Scene {
    let mut world = scene(
        &text.replace("size = [96, 64]", "size = [64, 64]").replace("[[camera]]\n", "[[camera]]\nfar = 60\n"),
    );
    world.point_lights = lights;
    world
}

fn matte() -> String {
    let mut text =
        FIVE_MATERIALS.replace("sigma = 30", std::env::var("SIGMA").as_deref().unwrap_or("sigma = 0"));
    for name in ["plastic", "metal", "substrate", "principled"] {
        text = text.replace(&format!("material = \"{name}\""), "material = \"matte\"");
    }
    text
}

/// Spheres with narrow lobes.
fn smooth() -> String {
    FIVE_MATERIALS
        .replace(
            "roughness = 0.4\n[[material]]\nname = \"metal",
            "alpha = 0.05\n[[material]]\nname = \"metal",
        )
        .replace("alpha = [0.2, 0.4]", "alpha = 0.1")
        .replace("roughness = 0.5\nanisotropic = 0.5", "alpha = 0.02")
}

struct Figures {
    mean: f64,
    p99: f64,
    bias: f64,
    estimate: f64,
}

fn brute(world: &Scene) -> HdrImage {
    Rig::with(world.clone(), |settings| settings.brute_force = true).render()
}

fn figures(world: &Scene, brute: &HdrImage, light_error: f32) -> Figures {
    let mut rig = Rig::with(world.clone(), |settings| settings.light_error = light_error);
    let picture = rig.render();
    let counters = rig.frame.counters();
    assert!(counters.cut_entries > 0, "there is a cut");
    let (targets, clusters) = rig.frame.cluster_targets();
    let ids: Vec<u32> =
        targets.cluster_ids.fetch(amas::gpu::Use::FragmentRead, amas::gpu::Use::FragmentRead).unwrap();
    let covered: Vec<usize> = (0..ids.len()).filter(|&i| ids[i] != NO_CLUSTER).collect();
    let floor = covered.iter().map(|&i| brute.pixels[i].iter().sum::<f32>() / 3.0).sum::<f32>()
        / covered.len() as f32;
    let floor = 0.01 * f64::from(floor);
    let mut errors = Vec::new();
    for &i in &covered {
        for c in 0..3 {
            let (a, b) = (f64::from(picture.pixels[i][c]), f64::from(brute.pixels[i][c]));
            errors.push((a - b) / b.max(floor));
        }
    }
    let n = errors.len() as f64;
    let bias = errors.iter().sum::<f64>() / n;
    let mut sizes: Vec<f64> = errors.iter().map(|e| e.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let estimate = rig.frame.light_error().unwrap();
    let found =
        Figures { mean: sizes.iter().sum::<f64>() / n, p99: sizes[(0.99 * n) as usize], bias, estimate };
    let clusters = clusters.clusters.fetch(amas::gpu::Use::ComputeWrite).unwrap();
    let count = counters.clusters as usize;
    let mean = |value: &dyn Fn(&amas::shared::Cluster) -> u32| {
        clusters[..count].iter().map(|c| f64::from(value(c))).sum::<f64>() / count as f64
    };
    println!(
        "  {light_error}: {:.0} nodes, {:.0} roots, {:.0} leaves, {:.0} visits; mean {:.5}, p99 {:.5}, bias {:+.5}, \
         estimate {:.5}, ratio {:.2}",
        mean(&|c| c.cut_nodes),
        mean(&|c| c.cut_roots),
        mean(&|c| c.cut_leaves),
        mean(&|c| c.cut_visits),
        found.mean,
        found.p99,
        found.bias,
        found.estimate,
        found.estimate / found.mean
    );
    found
}

#[test]
fn explore() {
    let count: usize = std::env::var("COUNT").map_or(30_000, |v| v.parse().unwrap());
    let text = match std::env::var("SCENE").as_deref() {
        Ok("five") => FIVE_MATERIALS.to_owned(),
        Ok("smooth") => smooth(),
        _ => matte(),
    };
    for kind in KINDS {
        println!("{kind:?}");
        let world = world(&text, lights(kind, count));
        let brute = brute(&world);
        for light_error in [0.05, 0.02, 0.01, 0.005] {
            figures(&world, &brute, light_error);
        }
    }
}
