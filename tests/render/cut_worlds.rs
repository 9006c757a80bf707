//! Lights without a range, and what they light, for the tests of cuts.

use crate::support::{FIVE_MATERIALS, scene};
use amas::Scene;
use amas::scene::PointLight;
use glam::{Mat3, Vec3};

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
pub(crate) enum Kind {
    Uniform,
    AlongSurfaces,
    OneDominant,
    OnePoint,
    BeyondFar,
    HalfBehind,
    TenDecades,
}

pub(crate) const KINDS: [Kind; 7] = [
    Kind::Uniform,
    Kind::AlongSurfaces,
    Kind::OneDominant,
    Kind::OnePoint,
    Kind::BeyondFar,
    Kind::HalfBehind,
    Kind::TenDecades,
];

/// Lights around [`FIVE_MATERIALS`].
pub(crate) fn lights(kind: Kind, count: usize) -> Vec<PointLight> {
    seeded(kind, count, 0)
}

/// Other lights for every seed.
pub(crate) fn seeded(kind: Kind, count: usize, seed: u32) -> Vec<PointLight> {
    let mut rng = Lcg(kind as u32 + 1 + 1000 * seed);
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

pub(crate) fn world(text: &str, lights: Vec<PointLight>) -> Scene {
    let mut world = scene(
        &text.replace("size = [96, 64]", "size = [64, 64]").replace("[[camera]]\n", "[[camera]]\nfar = 60\n"),
    );
    world.point_lights = lights;
    world
}

pub(crate) fn matte(sigma: u32) -> String {
    let mut text = FIVE_MATERIALS.replace("sigma = 30", &format!("sigma = {sigma}"));
    for name in ["plastic", "metal", "substrate", "principled"] {
        text = text.replace(&format!("material = \"{name}\""), "material = \"matte\"");
    }
    text
}

/// All of one glossy material, `plastic` or `metal`.
pub(crate) fn glossy(material: &str, alpha: f32) -> String {
    let mut text = FIVE_MATERIALS
        .replace(
            "roughness = 0.4\n[[material]]\nname = \"metal",
            &format!("alpha = {alpha}\n[[material]]\nname = \"metal"),
        )
        .replace("alpha = [0.2, 0.4]", &format!("alpha = {alpha}"));
    for name in ["matte", "plastic", "metal", "substrate", "principled"] {
        text = text.replace(&format!("material = \"{name}\""), &format!("material = \"{material}\""));
    }
    text
}

/// Spheres with narrow lobes.
pub(crate) fn smooth() -> String {
    FIVE_MATERIALS
        .replace(
            "roughness = 0.4\n[[material]]\nname = \"metal",
            "alpha = 0.05\n[[material]]\nname = \"metal",
        )
        .replace("alpha = [0.2, 0.4]", "alpha = 0.1")
        .replace("roughness = 0.5\nanisotropic = 0.5", "alpha = 0.02")
}

/// The proper rotations that turn axes into axes, as columns: the same world to a viewer, another order to the lights.
pub(crate) const TURNS: [[Vec3; 3]; 3] =
    [[Vec3::X, Vec3::Y, Vec3::Z], [Vec3::Y, Vec3::Z, Vec3::X], [Vec3::X, Vec3::NEG_Z, Vec3::Y]];

/// The world turned about the origin.
pub(crate) fn turned(mut world: Scene, columns: [Vec3; 3]) -> Scene {
    let turn = Mat3::from_cols(columns[0], columns[1], columns[2]);
    let apply = |v: [f32; 3]| (turn * Vec3::from(v)).to_array();
    for vertex in world.meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices) {
        vertex.position = apply(vertex.position);
        vertex.normal = apply(vertex.normal);
        let [x, y, z, handed] = vertex.tangent;
        let [x, y, z] = apply([x, y, z]);
        vertex.tangent = [x, y, z, handed];
    }
    for camera in &mut world.cameras {
        for v in [&mut camera.position, &mut camera.target, &mut camera.up] {
            *v = turn.as_dmat3() * *v;
        }
    }
    world.point_lights.iter_mut().for_each(|light| light.position = turn * light.position);
    world
}
