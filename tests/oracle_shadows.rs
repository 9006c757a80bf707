//! Visibility in the oracle: form factors of what is left of a light, shadows of known outline, nothing where nothing
//! shines.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod common;

use std::f64::consts::{PI, TAU};

use amas::HdrImage;
use amas::reference::{Integrator, Options, Rendered, render};
use amas::scene::{AreaLight, AreaShape, Material, Mesh, Parameter, Scene, Texels, Texture, Vertex};
use common::square::{options, scene};
use glam::{DVec3, Vec3, vec3};

/// Of the square's first channel.
const ALBEDO: f64 = 0.5;

fn shadowed(scene: &Scene, size: [u32; 2], tolerance: f64) -> Rendered {
    let options = Options { integrator: Integrator::Shadowed, tolerance, ..options(size) };
    render(scene, &scene.cameras[0], &options).unwrap()
}

fn direct(scene: &Scene, size: [u32; 2]) -> HdrImage {
    render(scene, &scene.cameras[0], &options(size)).unwrap().image
}

/// At the origin, seen from above.
fn center(scene: &Scene) -> [f32; 3] {
    shadowed(scene, [1, 1], 1e-3).image.pixels[0]
}

/// Flat, facing +z at height `z`, of the square's material.
fn sheet(x: [f32; 2], y: [f32; 2], z: f32) -> Mesh {
    let vertex = |[u, v]: [f32; 2]| Vertex {
        position: [x[0] + (x[1] - x[0]) * u, y[0] + (y[1] - y[0]) * v, z],
        normal: [0.0, 0.0, 1.0],
        tangent: [1.0, 0.0, 0.0, 1.0],
        uv: [u, v],
    };
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Mesh { vertices: corners.map(vertex).into(), triangles: vec![[0, 1, 2], [0, 2, 3]], material: 0 }
}

fn rect(x: [f32; 2], y: [f32; 2], z: f32) -> AreaLight {
    let shape = AreaShape::Rect {
        center: vec3(0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1]), z),
        u: Vec3::X * (0.5 * (x[1] - x[0])),
        v: Vec3::NEG_Y * (0.5 * (y[1] - y[0])),
    };
    AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible: false, texture: None }
}

/// The square under one area light.
fn under(light: AreaLight) -> Scene {
    Scene { area_lights: vec![light], point_lights: vec![], ..scene() }
}

/// Form factor of a rectangle `a` by `b` at height 1, one of whose corners is above the point.
fn corner(a: f64, b: f64) -> f64 {
    let part = |a: f64, b: f64| a / (1.0 + a * a).sqrt() * (b / (1.0 + a * a).sqrt()).atan();
    (part(a, b) + part(b, a)) / TAU
}

fn expect(what: &str, scene: &Scene, form_factor: f64) {
    let got = shadowed(scene, [1, 1], 2e-4);
    let (value, error) = (f64::from(got.image.pixels[0][0]), f64::from(got.standard_error.pixels[0][0]));
    let want = ALBEDO * form_factor;
    println!("{what}: {value:.7} ± {error:.1e}, want {want:.7}");
    assert!(error <= 1e-3 * want, "{what}: {error:e}");
    assert!((value - want).abs() <= 4.0 * error + 1e-6 * want, "{what}: {value} ± {error:e}, want {want}");
}

#[test]
fn half_plane_before_a_rectangle() {
    let light = || rect([-1.0, 1.0], [-1.0, 1.0], 1.0);
    expect("no occluder", &under(light()), 4.0 * corner(1.0, 1.0));
    // From the origin an edge at half the height covers twice as much of the light.
    for edge in [0.05_f32, 0.25, 0.49] {
        let want = 2.0 * (corner(1.0, 1.0) + corner(2.0 * f64::from(edge), 1.0));
        let sheet = sheet([edge, 1.5], [-2.0, 2.0], 0.5);
        let mut scene = under(light());
        scene.meshes.push(sheet.clone());
        expect("sheet", &scene, want);
        scene.materials[0].two_sided = false;
        expect("its back, not drawn, seen from below", &scene, want);
        scene.meshes[1].triangles.iter_mut().for_each(|triangle| triangle.reverse());
        expect("its front", &scene, want);
        // The same half plane as a luminaire that is black or shines upwards.
        let mut blocker = rect([edge, 1.5], [-2.0, 2.0], 0.5);
        if let AreaShape::Rect { u, .. } = &mut blocker.shape {
            *u = -*u;
        }
        blocker.visible = true;
        let mut scene = under(light());
        scene.area_lights.push(blocker);
        expect("the back of a luminaire", &scene, want);
        scene.area_lights[1].visible = false;
        expect("a light that is not seen", &scene, 4.0 * corner(1.0, 1.0));
    }
}

#[test]
fn slit_and_small_hole() {
    // Two sheets leave |x| < 0.01 at half the height: one in fifty of the light.
    let mut scene = under(rect([-1.0, 1.0], [-1.0, 1.0], 1.0));
    scene.meshes.push(sheet([0.01, 1.5], [-2.0, 2.0], 0.5));
    scene.meshes.push(sheet([-1.5, -0.01], [-2.0, 2.0], 0.5));
    let got = shadowed(&scene, [1, 1], 1e-3);
    let want = ALBEDO * 4.0 * corner(0.02, 1.0);
    let off = (f64::from(got.image.pixels[0][0]) - want).abs();
    assert!(off <= 4.0 * f64::from(got.standard_error.pixels[0][0]), "{got:?} {want}");
}

#[test]
fn luminaire_does_not_hide_itself() {
    let mut light = rect([-1.0, 1.0], [-1.0, 1.0], 1.0);
    let scene_of = |light: &AreaLight| {
        let mut scene = under(light.clone());
        scene.cameras[0].position = DVec3::new(0.0, 0.0, 0.5);
        scene
    };
    let unseen = scene_of(&light);
    light.visible = true;
    expect("seen", &scene_of(&light), 4.0 * corner(1.0, 1.0));
    assert_eq!(center(&scene_of(&light)), center(&unseen));
    let tube = AreaShape::Line { a: vec3(-1.0, 0.0, 1.0), b: vec3(1.0, 0.0, 1.0), radius: 0.1 };
    let seen = scene_of(&AreaLight { shape: tube, ..light });
    let mut unseen = seen.clone();
    unseen.area_lights[0].visible = false;
    assert_eq!(center(&seen), center(&unseen));
    assert!(center(&seen)[0] > 0.0);
}

#[test]
fn wall_before_a_point_light() {
    let free = scene();
    let mut walled = free.clone();
    walled.meshes.push(sheet([0.05, 1.0], [0.05, 1.0], 0.5));
    assert_eq!(center(&walled), [0.0; 3]);
    // Behind the light, beneath the surface, and right at the light: none of these is between.
    for (z, what) in [(1.5, "behind"), (-0.5, "beneath"), (1.0, "at the light"), (0.0, "on the surface")] {
        walled.meshes[1] = sheet([0.05, 1.0], [0.05, 1.0], z);
        assert_eq!(center(&walled), center(&free), "{what}");
    }
    walled.meshes[1] = sheet([0.05, 1.0], [0.05, 1.0], 1.0 - 1e-6);
    assert_eq!(center(&walled), [0.0; 3], "just before the light");
    let disk = AreaShape::Disk { center: vec3(0.15, 0.1, 0.5), u: Vec3::X * 0.1, v: Vec3::Y * 0.1 };
    let mut luminaire = free.clone();
    luminaire.area_lights =
        vec![AreaLight { shape: disk, radiance: Vec3::ZERO, two_sided: false, visible: true, texture: None }];
    assert_eq!(center(&luminaire), [0.0; 3]);
    luminaire.area_lights[0].visible = false;
    assert_eq!(center(&luminaire), center(&free));
}

#[test]
fn mask_lets_light_through() {
    let mut scene = scene();
    let free = center(&scene);
    let texels = Texels::Linear8(vec![[255; 4], [0; 4]]);
    scene.textures = vec![Texture { name: "mask".into(), width: 2, height: 1, texels }];
    let mut masked: Material = scene.materials[0].clone();
    masked.parameters[Parameter::Mask as usize].texture = Some(0);
    scene.materials.push(masked);
    // The light's ray passes at x = 0.15: the left half is there, the right half is cut.
    for (x, want) in [([0.1, 0.5], [0.0; 3]), ([-0.2, 0.2], free)] {
        // The texture wraps: stay away from the sheet's borders, where it mixes.
        scene.meshes.truncate(1);
        scene.meshes.push(Mesh { material: 1, ..sheet(x, [0.05, 1.0], 0.5) });
        assert_eq!(center(&scene), want, "{x:?}");
    }
}

/// Rings of `n` flat quads, poles along z.
fn sphere(center: Vec3, radius: f64, n: u32) -> Mesh {
    let vertex = |i: u32, j: u32| {
        let (phi, theta) = (TAU * f64::from(i % n) / f64::from(n), PI * f64::from(j) / f64::from(n));
        let ring = if j == 0 || j == n { 0.0 } else { theta.sin() };
        DVec3::new(ring * phi.cos(), ring * phi.sin(), theta.cos()).as_vec3()
    };
    let mut mesh = Mesh::default();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let quad = [vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)];
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            let [a, b, c] = triangle.map(|corner: usize| quad[corner]);
            let normal = (b - a).cross(c - a);
            if normal.length() < 1e-9 {
                continue;
            }
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend([a, b, c].map(|unit| Vertex {
                position: (center + unit * radius as f32).to_array(),
                normal: normal.normalize().to_array(),
                ..Vertex::default()
            }));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
    }
    mesh
}

/// The cone from the light touches the sphere, so the shadow is a disk; the sphere rests on the plane or floats.
#[test]
fn sphere_casts_a_disk() {
    for height in [0.2_f32, 0.5] {
        let (radius, n) = (0.2, 96);
        let mut scene = scene();
        scene.meshes.push(sphere(vec3(0.0, 0.0, height), radius, n));
        scene.point_lights[0].position = Vec3::Z;
        let size = 65;
        let got = shadowed(&scene, [size, size], 1e-3).image;
        let free = direct(&scene, [size, size]);
        let below_light = 1.0 - f64::from(height);
        let disk = radius / (below_light * below_light - radius * radius).sqrt();
        let pixel = 2.0 * 2.0 * 30.0_f64.to_radians().tan() / f64::from(size);
        let mut dark = 0;
        for (i, (got, free)) in got.pixels.iter().zip(&free.pixels).enumerate() {
            let place = |k: usize| (k as f64 + 0.5 - 0.5 * f64::from(size)) * pixel;
            let from_axis = place(i % size as usize).hypot(place(i / size as usize));
            // The camera's own cone hides the middle; facets touch the sphere from inside, by 1 − cos(π/n).
            let from_eye = 2.0 - f64::from(height);
            let hidden = 2.0 * radius / (from_eye * from_eye - radius * radius).sqrt();
            if from_axis > disk * 1.001 {
                assert_eq!(got, free, "lit at {from_axis}");
            } else if from_axis < disk * 0.997 && from_axis > hidden * 1.001 {
                assert_eq!(*got, [0.0; 3], "dark at {from_axis}");
                dark += 1;
            }
        }
        assert!(dark > 20, "{dark} pixels of the disk are seen at height {height}");
    }
}

/// A convex body shades itself by its normals alone: flat facets have no acne, and beyond the terminator is no light.
#[test]
fn facets_shade_themselves_without_acne() {
    let mut scene = scene();
    scene.meshes = vec![sphere(Vec3::ZERO, 0.9, 40)];
    scene.point_lights[0].position = vec3(5.0, 3.0, 2.0);
    let size = [80, 80];
    assert_eq!(shadowed(&scene, size, 1e-3).image, direct(&scene, size));
}

#[test]
fn triangle_hides_what_its_normals_lean_to() {
    let mut scene = scene();
    for vertex in &mut scene.meshes[0].vertices {
        vertex.normal = [0.8, 0.0, 0.6];
    }
    scene.point_lights[0].position = vec3(3.0, 0.0, -1.0);
    let unshadowed = direct(&scene, [1, 1]).pixels[0];
    assert!(unshadowed[0] > 0.0);
    assert_eq!(center(&scene), [0.0; 3]);
}
