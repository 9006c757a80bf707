//! Look-ups in the textures of lights against double precision.

use amas::area_lights::AreaLights;
use amas::gpu::{Specialization, shaders};
use amas::gpu_scene::Area;
use amas::scene::mips::{Level, levels};
use amas::scene::{AreaLight, AreaShape, Scene, Texels, Texture};
use glam::{DVec3, Vec3};

use crate::common::gpu::CheckedGpu;

/// Bilinear and clamped, (0, 0) at the lower left.
fn sample(level: &Level, u: f64, v: f64) -> DVec3 {
    let size = level.size.map(|side| side as f64);
    let (x, y) = (u * size[0] - 0.5, (1.0 - v) * size[1] - 0.5);
    let texel = |dx: f64, dy: f64| {
        let column = (x.floor() + dx).clamp(0.0, size[0] - 1.0) as usize;
        let row = (y.floor() + dy).clamp(0.0, size[1] - 1.0) as usize;
        let [r, g, b, _] = level.texels[row * level.size[0] + column].map(f64::from);
        DVec3::new(r, g, b)
    };
    let (s, t) = (x - x.floor(), y - y.floor());
    texel(0.0, 0.0).lerp(texel(1.0, 0.0), s).lerp(texel(0.0, 1.0).lerp(texel(1.0, 1.0), s), t)
}

/// At level `lod`, between two of them.
fn between(levels: &[Level], [u, v, lod]: [f64; 3]) -> DVec3 {
    let lod = lod.clamp(0.0, (levels.len() - 1) as f64);
    let [below, above] = [lod.floor(), lod.ceil()].map(|level| sample(&levels[level as usize], u, v));
    below.lerp(above, lod.fract())
}

/// Textures of many sizes side by side, one of them beyond what halves hold, two lights with the same.
#[test]
fn texels_of_any_size_are_found_at_every_level() {
    let mut state = 3_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    };
    let sizes = [[1, 1], [7, 3], [64, 64], [33, 130], [1, 19], [2500, 3]];
    let textures: Vec<_> = sizes
        .map(|[width, height]| {
            let texel = |_| [1e6 * next(), next(), 1e-3 * next(), 1.0];
            let texels = Texels::Float((0..width * height).map(texel).collect());
            Texture { name: "t".into(), width, height, texels }
        })
        .into();
    let light = |texture: u32| AreaLight {
        shape: AreaShape::Rect { center: Vec3::ZERO, u: Vec3::X, v: Vec3::Y },
        radiance: Vec3::ONE,
        two_sided: false,
        visible: false,
        texture: Some(texture),
    };
    let area_lights = [0, 1, 2, 3, 4, 5, 2].map(light).into();
    let scene = Scene { area_lights, textures, ..Scene::default() };
    let device = CheckedGpu::open();
    let lights = AreaLights::new(&scene, Vec3::ZERO).unwrap();
    let area = Area::new(&device, &lights, vec![], false).unwrap();
    let rows: Vec<[f32; 4]> = (0..4000)
        .map(|i| {
            let lod = if i % 2 == 0 { 0.0 } else { 14.0 * next() - 1.0 };
            [1.2 * next() - 0.1, 1.2 * next() - 0.1, lod, (i % 7) as f32]
        })
        .collect();
    let bind = |set: amas::gpu::DescriptorSet<'_>| area.bind(set);
    let none = Specialization::default();
    let found: Vec<[f32; 4]> =
        amas::probe::run_among(&device, shaders::PROBE_AREA_TEXEL_COMP, &none, &bind, &rows).unwrap();
    let chains: Vec<_> = scene.textures.iter().map(levels).collect();
    let mut worst = 0.0_f64;
    for ([u, v, lod, light], [r, g, b, _]) in rows.iter().zip(&found) {
        let texture = scene.area_lights[*light as usize].texture.unwrap();
        let want = between(&chains[texture as usize], [u, v, lod].map(|x| f64::from(*x)));
        let error =
            (DVec3::new(f64::from(*r), f64::from(*g), f64::from(*b)) - want) / DVec3::new(1e6, 1.0, 1e-3);
        worst = worst.max(error.abs().max_element());
    }
    println!("worst {worst:.1e}");
    // Of 2,500 texels across, float32 coordinates miss a place by 1e-4 of a texel.
    assert!(worst < 3e-4, "{worst}");
    device.finish();
}
