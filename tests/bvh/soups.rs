//! Random triangles, and those that no mesh should hold.

use amas::scene::Scene;
use glam::{Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::exact::judge;
use crate::probe::{Random, occluded, random_soup, ray, soup, sphere, triangles};
use amas::shared::RayProbeRow;

const RAYS: usize = 8192;

fn rays(random: &mut Random, center: Vec3, half: f32) -> Vec<RayProbeRow> {
    let any = |_| {
        let origin = center + random.place() * (1.3 * half);
        let target = center + random.place() * half;
        match (random.number() * 3.0) as u32 {
            // Between two places, as towards a light.
            0 => ray(origin, (target - origin).normalize(), 0.0, (target - origin).length()),
            1 => ray(origin, random.direction(), 0.3 * half * random.number(), half * random.number()),
            _ => ray(origin, random.direction(), 0.0, 1e6 * half),
        }
    };
    (0..RAYS).map(any).collect()
}

#[test]
fn random_triangles() {
    let gpu = CheckedGpu::open();
    let mut random = Random(1);
    let cases = [
        (1, 1.0, 1.0),
        (5, 1.0, 1.0),
        (60, 1.0, 1.0),
        (2000, 1.0, 0.1),
        (3000, 1e3, 30.0),
        (2000, 1e-3, 2e-4),
    ];
    for (count, half, size) in cases {
        for center in [Vec3::ZERO, vec3(90.0, -40.0, 7.0) * half] {
            let soup = soup(&random_soup(&mut random, count, center, half, size));
            let rows = rays(&mut random, center, half);
            let got = occluded(&gpu, &soup, &rows);
            let counts = judge(&format!("{count} of {size}"), &triangles(&soup), &rows, &got);
            assert!(counts[0] > 10 && counts[1] * 200 < RAYS && counts[2] > 10, "{counts:?}");
        }
    }
    gpu.finish();
}

/// Coordinates of a coarse grid: rays along axes, in planes of triangles, through corners and edges; flat boxes.
#[test]
fn degenerate_rays_and_triangles() {
    let gpu = CheckedGpu::open();
    let mut random = Random(2);
    let grid = |random: &mut Random| (random.place() * 2.5).round();
    let mut all: Vec<[Vec3; 3]> = (0..120).map(|_| [(); 3].map(|()| grid(&mut random))).collect();
    // Without area: points, segments, and three places of a line.
    all.extend((0..40).map(|_| [grid(&mut random); 3]));
    all.extend((0..40).map(|_| [Vec3::ONE, Vec3::ONE, grid(&mut random)]));
    all.extend((0..40).map(|i| [0.0, 1.0, 2.0].map(|t| vec3(t, t, i as f32 / 20.0 - 1.0))));
    let soup = soup(&all);
    let axis = |random: &mut Random| {
        let mut direction = [0.0; 3];
        direction[(random.number() * 3.0) as usize] = if random.number() < 0.5 { -1.0 } else { 1.0 };
        Vec3::from(direction)
    };
    let rows: Vec<_> = (0..RAYS)
        .map(|i| {
            let jitter = if i % 4 < 2 { Vec3::ZERO } else { random.place() * 0.4 };
            let origin = grid(&mut random) + jitter;
            let to = grid(&mut random) - origin;
            let direction = if i % 2 == 0 || to == Vec3::ZERO { axis(&mut random) } else { to.normalize() };
            ray(origin, direction, 0.0, [1.0, 3.0, 1e9][i % 3])
        })
        .collect();
    let got = occluded(&gpu, &soup, &rows);
    let counts = judge("grid", &triangles(&soup), &rows, &got);
    assert!(counts[0] > 500 && counts[2] > 500, "{counts:?}");
    gpu.finish();
}

/// Boxes and triangles meet without a gap: a closed surface holds every ray from within, through edges and corners too.
#[test]
fn nothing_slips_through_a_closed_surface() {
    let gpu = CheckedGpu::open();
    let mut random = Random(3);
    let sphere = sphere(vec3(0.3, 0.1, -0.2));
    let rows: Vec<_> = (0..4 * RAYS)
        .map(|i| {
            let origin = vec3(0.3, 0.1, -0.2) + random.place() * 0.8;
            let [a, b, _] = sphere[(random.number() * sphere.len() as f32) as usize];
            // To corners, to places of edges, and anywhere.
            let target = [a, a + (b - a) * random.number(), origin + random.direction()][i % 3];
            ray(origin, (target - origin).normalize(), 0.0, 100.0)
        })
        .collect();
    let got = occluded(&gpu, &soup(&sphere), &rows);
    let through = got.iter().filter(|&&hidden| !hidden).count();
    assert_eq!(through, 0, "of {}", rows.len());
    gpu.finish();
}

#[test]
fn nothing_hides_in_an_empty_scene() {
    let gpu = CheckedGpu::open();
    let rows = rays(&mut Random(4), Vec3::ZERO, 1.0);
    assert!(!occluded(&gpu, &Scene::default(), &rows).contains(&true));
    gpu.finish();
}
