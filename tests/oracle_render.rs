//! Point lights, luminaires and whole small pictures of the oracle.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod common;

use amas::reference::lights::{Bounds, falloff, reaching, reaching_point};
use amas::reference::rays::camera_ray;
use amas::reference::{Options, render};
use amas::scene::{AreaLight, AreaShape, PointLight, Scene};
use common::square::{center, options, scene};
use glam::{DVec3, Vec3, vec3};

#[test]
fn lambert_under_a_point_light() {
    let scene = scene();
    let size = [9, 5];
    let image = render(&scene, &scene.cameras[0], &options(size)).unwrap().image;
    for (i, got) in image.pixels.iter().enumerate() {
        let (x, y) = ((i % 9) as f64 + 0.5, (i / 9) as f64 + 0.5);
        let ray = camera_ray(&scene.cameras[0], size, x, y).ray;
        let p = ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
        let to_light = scene.point_lights[0].position.as_dvec3() - p;
        let cos_over_d2 = to_light.z / to_light.length().powi(3);
        let lit = p.abs().max_element() < 2.0;
        for (c, albedo) in [0.5, 0.25, 1.0].into_iter().enumerate() {
            let intensity = f64::from(scene.point_lights[0].intensity[c]);
            let want = albedo / std::f64::consts::PI * intensity * cos_over_d2;
            let want = if lit { want } else { 0.0 };
            assert!((f64::from(got[c]) - want).abs() <= 1e-7 * want, "{got:?} {want}");
        }
    }
}

#[test]
fn luminaires_are_seen_and_occlude() {
    let mut scene = scene();
    scene.render.background = [7.0; 3];
    let shape = AreaShape::Rect { center: Vec3::Z, u: Vec3::X * 0.1, v: Vec3::Y * 0.1 };
    let radiance = vec3(3.0, 2.0, 1.0);
    let light = AreaLight { shape, radiance, two_sided: false, visible: true, texture: None };
    scene.area_lights = vec![light];
    assert_eq!(center(&scene), [3.0, 2.0, 1.0]);
    if let AreaShape::Rect { u, .. } = &mut scene.area_lights[0].shape {
        *u = -*u;
    }
    assert_eq!(center(&scene), [0.0; 3], "the back of a luminaire is black");
    scene.area_lights[0].visible = false;
    assert!(center(&scene)[0] > 0.0);
}

#[test]
fn ranged_lights_by_the_tree_are_all_of_them() {
    let mut scene = scene();
    let number = |i: u32, k: u32| (i.wrapping_mul(2_654_435_761 + 40_503 * k) >> 8) as f32 / 16_777_216.0;
    let light = |i: u32| PointLight {
        position: vec3(4.0 * number(i, 0) - 2.0, 4.0 * number(i, 1) - 2.0, number(i, 2)),
        intensity: Vec3::splat(0.01),
        range: Some(0.05 + number(i, 3)),
    };
    scene.point_lights = (0..3000).map(light).collect();
    let all = render(&scene, &scene.cameras[0], &options([8, 8])).unwrap().image;
    let mut sums = vec![[0.0_f64; 3]; 64];
    for light in scene.point_lights.clone() {
        let one = Scene { point_lights: vec![light], ..scene.clone() };
        let one = render(&one, &one.cameras[0], &options([8, 8])).unwrap().image;
        for (sum, pixel) in sums.iter_mut().zip(one.pixels) {
            sum.iter_mut().zip(pixel).for_each(|(sum, value)| *sum += f64::from(value));
        }
    }
    for (got, want) in all.pixels.iter().zip(sums) {
        assert!((f64::from(got[0]) - want[0]).abs() <= 1e-6 * want[0]);
    }
}

#[test]
fn falloff_and_membership() {
    assert_eq!(falloff(4.0, None), 0.25);
    assert_eq!(falloff(0.0, None), 1e12);
    assert!((falloff(1e-6, Some(1.0)) - 1e4).abs() < 1e-3);
    assert_eq!(falloff(0.25, Some(1.0)), (1.0_f64 - 0.0625).powi(2) / 0.25);
    assert_eq!(falloff(1.0, Some(1.0)), 0.0);
    let light = |x: f32, range| PointLight { position: vec3(x, 0.0, 0.0), intensity: Vec3::ONE, range };
    let lights = [light(3.0, Some(1.5)), light(3.0, Some(2.5)), light(9.0, None), light(0.5, Some(0.1))];
    let unit = Bounds { min: DVec3::ZERO, max: DVec3::ONE };
    assert_eq!(reaching(&lights, &unit), [1, 2, 3]);
    assert_eq!(reaching_point(&lights, DVec3::new(2.0, 0.0, 0.0)), [0, 1, 2]);
}

#[test]
fn pictures_do_not_depend_on_threads() {
    let mut scene = scene();
    let shape = AreaShape::Rect { center: vec3(0.0, 0.5, 1.0), u: Vec3::X, v: Vec3::NEG_Y };
    let radiance = Vec3::ONE;
    let light = AreaLight { shape, radiance, two_sided: false, visible: false, texture: None };
    scene.area_lights = vec![light];
    let options = Options { spp: 3, seed: 5, tolerance: 1e-2, ..options([6, 4]) };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&scene, &scene.cameras[0], &options).unwrap())
    };
    let one = with(1);
    assert_eq!(one, with(3));
    assert!(one.standard_error.pixels.iter().all(|pixel| pixel[0] > 0.0));
}

#[test]
fn what_is_missing_is_said() {
    let scene = scene();
    for options in
        [options([0, 1]), Options { spp: 0, ..options([1, 1]) }, Options { paths: 0, ..options([1, 1]) }]
    {
        let error = render(&scene, &scene.cameras[0], &options).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("at least 1"));
    }
}
