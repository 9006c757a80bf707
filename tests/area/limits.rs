//! Where form factors are lost: tiny, far and edge-on lights, lights below the horizon, points on the light, and lights in
//! parts: T10, T11, T13, T15, T17.

use glam::{DVec3, Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::probe::{Ellipse, Outline, ellipses, polygon, polygons};
use crate::truth::{Random, outline as truth};

/// Of lights too small for an absolute bound.
const RELATIVE: f64 = 1e-3;

fn square(center: Vec3, u: Vec3, v: Vec3) -> Outline {
    Outline { center, rings: vec![vec![u + v, v - u, -u - v, u - v]] }
}

/// Squares of half the size `size`, at a cosine of at least .02 on both sides: below, rounding of the center counts.
fn seen(random: &mut Random, distance: f64, size: f64) -> Outline {
    loop {
        let (normal, direction) = (random.direction(), random.direction());
        if direction.z < 0.02 || normal.dot(direction).abs() < 0.02 {
            continue;
        }
        let (u, v) = normal.any_orthonormal_pair();
        let [u, v] = [u, v].map(|axis| (size * axis).as_vec3());
        return square((distance * direction).as_vec3(), u, v);
    }
}

fn relative(name: &str, make: impl Fn(&mut Random) -> Outline) {
    let gpu = CheckedGpu::open();
    let outlines: Vec<_> = (0..100_000).map(|i| make(&mut Random::new(i))).collect();
    let mut worst: f64 = 0.0;
    for (outline, got) in outlines.iter().zip(polygons(&gpu, &outlines)) {
        let want = truth_from_center(outline);
        let error = (got / want - 1.0).abs();
        assert!(error <= RELATIVE, "{name}: {got:e}, want {want:e}\n{outline:?}");
        worst = worst.max(error);
    }
    println!("{name}: worst relative error {worst:.1e}");
    gpu.finish();
}

/// Below 1e-4 rad even double precision loses the edge sum: a 32 × 32 Gauss-like midpoint rule over the square is exact
/// to 1e-3 of (size/distance)² there.
fn truth_from_center(outline: &Outline) -> f64 {
    let size = f64::from(outline.rings[0][0].length()) / outline.center.as_dvec3().length();
    if size > 1e-4 {
        return truth(outline);
    }
    let ring: Vec<_> = outline.rings[0].iter().map(|v| v.as_dvec3()).collect();
    let (u, v) = (0.5 * (ring[0] - ring[1]), 0.5 * (ring[0] - ring[3]));
    let normal = 4.0 * u.cross(v);
    let mut sum = 0.0;
    for i in 0..32 {
        for j in 0..32 {
            let at = |k: i32| (f64::from(k) + 0.5) / 16.0 - 1.0;
            let p = outline.center.as_dvec3() + at(i) * u + at(j) * v;
            sum -= normal.dot(p) * p.z / (std::f64::consts::PI * p.length_squared().powi(2));
        }
    }
    sum / 1024.0
}

#[test]
fn tiny_lights() {
    for size in [1e-2, 1e-3, 1e-4, 1e-5] {
        relative(&format!("T15 {size:e} rad"), |random| seen(random, 1.0, size));
    }
    relative("any size", |random| {
        let (distance, size) = (random.ratio(1e-2, 1e4), random.ratio(1e-5, 3.0));
        seen(random, distance, distance * size)
    });
}

#[test]
fn far_lights() {
    relative("T15 a metre at 1e6 m", |random| seen(random, 1e6, 1.0));
}

/// Edge-on: planes through the origin of integer coordinates, so that float32 holds them exactly.
#[test]
fn edge_on_lights() {
    let gpu = CheckedGpu::open();
    let outlines: Vec<_> = (0..100_000)
        .map(|i| {
            let mut random = Random::new(i);
            let mut small = || random.choice(17) as f32 - 8.0;
            let [s, t] = std::array::from_fn(|_| vec3(small(), small(), small()));
            // Beside the origin, so that no side is meant.
            let ring = [[1.0, 4.0], [5.0, 1.0], [7.0, 8.0], [2.0, 6.0]].map(|[x, y]| x * s + y * t);
            Outline { rings: vec![ring.into()], ..Outline::default() }
        })
        .collect();
    let worst = polygons(&gpu, &outlines).into_iter().map(f64::abs).fold(0.0, f64::max);
    println!("T10: {worst:.1e}");
    assert!(worst < 2e-7, "{worst:e}");
    let disks: Vec<_> = outlines
        .iter()
        .map(|outline| {
            let [a, b] = [outline.rings[0][0], outline.rings[0][1]];
            Ellipse { center: 3.0 * a + 2.0 * b, a, b: a - 2.0 * b }
        })
        .collect();
    let worst = ellipses(&gpu, &disks).into_iter().map(f64::abs).fold(0.0, f64::max);
    println!("T10 ellipses: {worst:.1e}");
    assert!(worst < 2e-7, "{worst:e}");
    gpu.finish();
}

#[test]
fn lights_below_the_horizon() {
    let gpu = CheckedGpu::open();
    let below = |random: &mut Random| {
        let mut outline = seen(random, 1.0, 0.01);
        outline.center.z *= -1.0;
        outline
    };
    let outlines: Vec<_> = (0..10_000).map(|i| below(&mut Random::new(i))).collect();
    assert!(polygons(&gpu, &outlines).into_iter().all(|e| e == 0.0), "T13");
    gpu.finish();
}

/// T11: along the normal of a light through a point inside it, in the light's plane 0 or ±1, never more.
#[test]
fn a_point_on_the_light() {
    let gpu = CheckedGpu::open();
    let heights = [0.0, 1e-30, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6];
    for h in heights {
        // Facing down, over the point: the whole hemisphere. In the surface's plane it counts as above.
        let facing = square(vec3(0.1, -0.2, h), Vec3::X, Vec3::NEG_Y);
        let got = polygon(&gpu, &facing);
        assert!((got - 1.0).abs() < 1e-6 + f64::from(h), "{h:e}: {got}");
        assert_eq!(polygon(&gpu, &square(vec3(0.1, -0.2, -1e-9), Vec3::X, Vec3::NEG_Y)), 0.0);
        // Standing across the surface, through it: one half from its front, minus one half from behind, 0 between.
        let standing = square(vec3(h, 0.1, 0.2), Vec3::Y, Vec3::Z);
        let sides = [standing.clone(), standing.map(|v| v.with_x(-v.x))].map(|light| polygon(&gpu, &light));
        println!("T11 at {h:e}: over {got}, beside {sides:?}");
        // The convention is that of length: 1e-30 m is no distance in float32.
        let want = if h < 1e-18 { 0.0 } else { 0.5 };
        let half = sides.map(|side| (side.abs() - want).abs());
        assert!(half.into_iter().all(|off| off < 1e-6 + f64::from(h)), "{h:e}: {sides:?}");
        let disk = Ellipse { center: vec3(0.1, -0.2, h), a: Vec3::X, b: Vec3::Y };
        let got = ellipses(&gpu, &[disk])[0];
        let want = if h < 1e-18 { 0.0 } else { 1.0 };
        assert!((got - want).abs() < 1e-6 + f64::from(h), "disk at {h:e}: {got}");
    }
    gpu.finish();
}

/// T15: no vertex is special, however it is repeated or lies between others.
#[test]
fn repeated_and_collinear_vertices() {
    let gpu = CheckedGpu::open();
    let mut random = Random::new(3);
    for _ in 0..200 {
        let (center, u, v) = (random.cube().as_vec3(), random.cube().as_vec3(), random.cube().as_vec3());
        let plain = Outline { center, ..square(center, u, v) };
        let ring = &plain.rings[0];
        let middle = 0.5 * (ring[0] + ring[1]);
        let odd = vec![ring[0], ring[0], middle, middle, ring[1], ring[2], ring[2], ring[3], ring[3]];
        let odd = Outline { center, rings: vec![odd] };
        let off = (polygon(&gpu, &plain) - polygon(&gpu, &odd)).abs();
        assert!(off < 1e-6, "{off:e} {plain:?}");
    }
    gpu.finish();
}

/// T17: the sum over a light in parts is the light.
#[test]
fn parts_sum_to_the_whole() {
    let gpu = CheckedGpu::open();
    let count = 20_000;
    let wholes: Vec<_> = (0..count)
        .map(|i| {
            let mut random = Random::new(i);
            let (center, u, v) = (2.0 * random.cube(), random.cube(), random.cube());
            // Coordinates of few bits, so that the parts meet exactly.
            let [center, u, v] = [center, u, v].map(|p: DVec3| (p * 64.0).round().as_vec3() / 64.0);
            (center, u, v)
        })
        .collect();
    let whole: Vec<_> = wholes.iter().map(|&(c, u, v)| square(Vec3::ZERO, u, v).map(|p| p + c)).collect();
    let absolute = |outline: &Outline| Outline { center: Vec3::ZERO, rings: outline.rings.clone() };
    let whole: Vec<_> = whole.iter().map(absolute).collect();
    let parts: Vec<_> = wholes
        .iter()
        .flat_map(|&(c, u, v)| {
            [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[s, t]| {
                let part = square(Vec3::ZERO, 0.5 * u, 0.5 * v).map(|p| p + c + 0.5 * (s * u + t * v));
                absolute(&part)
            })
        })
        .collect();
    let sums = polygons(&gpu, &parts);
    let mut worst: f64 = 0.0;
    for (i, (got, parts)) in polygons(&gpu, &whole).into_iter().zip(sums.chunks(4)).enumerate() {
        let off = (got - parts.iter().sum::<f64>()).abs();
        // Where an edge nearly meets the point, either may round to the other side.
        if crate::truth::sensitivity(&whole[i]) < 10.0 {
            assert!(off < 1e-6, "T17: {off:e} {:?}", whole[i]);
            worst = worst.max(off);
        }
    }
    println!("T17: {worst:.1e}");
    gpu.finish();
}
