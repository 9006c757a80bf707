//! Camera rays of the oracle, and what they hit.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod common;

use amas::reference::rays::{Geometry, camera_ray};
use amas::reference::render;
use amas::scene::{Parameter, Projection, Texels, Texture};
use common::square::{camera, center, options, perspective, scene};
use glam::DVec3;

#[test]
fn perspective_rays_follow_the_contract() {
    let (camera, [w, h]) = (perspective(), [320.0_f64, 240.0_f64]);
    let tangent = 30.0_f64.to_radians().tan();
    for (x, y) in [(0.0, 0.0), (17.0, 200.0), (319.0, 239.0)] {
        let got = camera_ray(&camera, [320, 240], x + 0.5, y + 0.5);
        let right = tangent * (w / h) * (2.0 * (x + 0.5) / w - 1.0);
        let up = tangent * (1.0 - 2.0 * (y + 0.5) / h);
        let want = DVec3::new(right, up, -1.0);
        assert!(got.ray.direction.abs_diff_eq(want.normalize(), 1e-15));
        assert!((got.t_min - 0.05 * want.length()).abs() < 1e-15, "near is along the view");
    }
}

#[test]
fn orthographic_rays_follow_the_contract() {
    let camera = camera(Projection::Orthographic { height: 3.0 });
    let got = camera_ray(&camera, [4, 2], 0.5, 0.5).ray;
    assert!(got.origin.abs_diff_eq(DVec3::new(-2.25, 0.75, 2.0), 1e-15));
    assert_eq!(got.direction, DVec3::NEG_Z);
}

#[test]
fn facing() {
    let mut scene = scene();
    let from_front = center(&scene);
    scene.meshes[0].triangles.iter_mut().for_each(|t| t.reverse());
    assert_eq!(center(&scene), from_front, "the normal turns to the viewer whatever the winding");
    scene.materials[0].two_sided = false;
    scene.render.background = [7.0; 3];
    assert_eq!(center(&scene), [7.0; 3], "a one-sided back face is not drawn");
    scene.meshes[0].triangles.iter_mut().for_each(|t| t.reverse());
    assert_eq!(center(&scene), from_front);
}

#[test]
fn near_and_far_planes_cut() {
    let mut scene = scene();
    scene.render.background = [7.0; 3];
    scene.cameras[0].near = 2.0 + 1e-9;
    assert_eq!(center(&scene), [7.0; 3]);
    scene.cameras[0].near = 0.1;
    scene.cameras[0].far = Some(2.0 - 1e-9);
    assert_eq!(center(&scene), [7.0; 3]);
}

#[test]
fn alpha_mask_cuts() {
    let mut scene = scene();
    scene.render.background = [7.0; 3];
    // The upper row is opaque, the lower one is cut: v runs upwards, row 0 is on top.
    let texels = Texels::Linear8(vec![[255; 4], [0; 4]]);
    scene.textures = vec![Texture { name: "mask".into(), width: 1, height: 2, texels }];
    scene.materials[0].parameters[Parameter::Mask as usize].texture = Some(0);
    let image = render(&scene, &scene.cameras[0], &options([1, 8])).unwrap().image;
    let cut: Vec<_> = image.pixels.iter().map(|pixel| *pixel == [7.0; 3]).collect();
    assert_eq!(cut, [false, false, false, false, true, true, true, true]);
}

#[test]
fn no_ray_slips_through_an_edge() {
    let scene = scene();
    let geometry = Geometry::new(&scene);
    let camera = &scene.cameras[0];
    // The diagonal is the triangles' common edge, and the picture is square, so every ray of it meets that edge.
    let all = (0..=64_u32).all(|i| {
        let at = f64::from(i);
        geometry.closest(&camera_ray(camera, [64, 64], at, 64.0 - at)).is_some()
    });
    assert!(all);
}
