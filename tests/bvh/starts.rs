//! Rays that leave a surface do not meet it again.

use glam::{Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::probe::{Random, occluded, ray, soup};
use amas::shared::RayProbeRow;

/// A ray from a place of the triangle into the half space above it, moved off it as shaders do.
fn leaving(random: &mut Random, [a, b, c]: [Vec3; 3], grazing: f32) -> RayProbeRow {
    let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
    let (mut u, mut v) = (f64::from(random.number()), f64::from(random.number()));
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    let p = (a + u * (b - a) + v * (c - a)).as_vec3();
    let normal = (b - a).cross(c - a).normalize().as_vec3();
    let mut direction = random.direction();
    direction -= normal * direction.dot(normal) * (1.0 - grazing);
    if direction.dot(normal) < 0.0 {
        direction -= 2.0 * normal * direction.dot(normal);
    }
    let row = ray(p, direction.normalize(), 0.0, 1e6);
    RayProbeRow { normal: normal.to_array(), way: 0.0, ..row }
}

#[test]
fn no_acne() {
    let gpu = CheckedGpu::open();
    let mut random = Random(21);
    for grazing in [1.0, 0.1, 1e-3] {
        for (size, far) in [(1.0, 1.0), (300.0, 1.0), (1.0, 300.0), (0.01, 3.0), (1e4, 1e4)] {
            // A sheet of two triangles at a time, anywhere, of any inclination.
            let mut differ = 0;
            for _ in 0..24 {
                let corner = random.place() * far;
                let [u, v] = [random.direction() * size, random.direction() * size];
                let sheet = [[corner, corner + u, corner + u + v], [corner, corner + u + v, corner + v]];
                let rows: Vec<_> = (0..512).map(|i| leaving(&mut random, sheet[i % 2], grazing)).collect();
                let got = occluded(&gpu, &soup(&sheet), &rows);
                differ += got.iter().filter(|&&hidden| hidden).count();
            }
            println!("grazing {grazing}, size {size}, at {far}: {differ} of {}", 24 * 512);
            assert_eq!(differ, 0, "grazing {grazing}, size {size}, at {far}");
        }
    }
    gpu.finish();
}

/// A start near the origin on a very large triangle: the arithmetic that meets it again is coarser than the start is.
#[test]
fn no_acne_in_the_middle_of_a_large_triangle() {
    let gpu = CheckedGpu::open();
    let mut random = Random(22);
    for grazing in [1.0, 0.1, 1e-2] {
        let mut hits = 0;
        for _ in 0..24 {
            let u = random.direction();
            let v = u.cross(random.direction()).normalize();
            let center = random.place();
            let around = |s: f32, t: f32, size: f32| center + (u * s + v * t) * size;
            let corners =
                |size: f32| [[-1.0, -1.0], [2.0, -0.7], [-0.8, 2.0]].map(|[s, t]| around(s, t, size));
            let rows: Vec<_> = (0..512).map(|_| leaving(&mut random, corners(0.1), grazing)).collect();
            hits += occluded(&gpu, &soup(&[corners(1e3)]), &rows).iter().filter(|&&hidden| hidden).count();
        }
        println!("grazing {grazing}: {hits} of {}", 24 * 512);
        assert_eq!(hits, 0, "grazing {grazing}");
    }
    gpu.finish();
}

/// A wall that stands on the floor shades it right up to their common edge.
#[test]
fn no_leak_at_contact() {
    let gpu = CheckedGpu::open();
    let wall = [
        [vec3(0.0, 0.0, -5.0), vec3(0.0, 0.0, 5.0), vec3(0.0, 4.0, 5.0)],
        [vec3(0.0, 0.0, -5.0), vec3(0.0, 4.0, 5.0), vec3(0.0, 4.0, -5.0)],
    ];
    let towards = |distance: f32| {
        let row = ray(vec3(distance, 0.0, 0.7), vec3(-0.8, 0.6, 0.0), 0.0, 20.0);
        RayProbeRow { normal: [0.0, 1.0, 0.0], way: 5.0, ..row }
    };
    let rows: Vec<_> = (0..40).map(|i| towards(1e-4 * 1.25_f32.powi(i))).collect();
    let got = occluded(&gpu, &soup(&wall), &rows);
    assert!(got.iter().all(|&hidden| hidden), "{got:?}");
    gpu.finish();
}
