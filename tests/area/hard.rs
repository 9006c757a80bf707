//! Random outlines of the kinds that break form factors in float32, against double precision.

use glam::{DVec3, Vec3};

use crate::common::gpu::CheckedGpu;
use crate::probe::{Outline, polygons};
use crate::truth::{Random, outline as truth, sensitivity};

const CASES: usize = 100_000;
/// Error of a float32 sum of a dozen terms of the order of 1.
const ABSOLUTE: f64 = 2e-6;
/// Of a vertex, relative; and what an edge near the origin makes of it.
const ROUNDING: f64 = 1.2e-7;

fn rounded(points: impl IntoIterator<Item = DVec3>) -> Vec<Vec3> {
    points.into_iter().map(DVec3::as_vec3).collect()
}

/// A star around the middle of a plane: concave, never self-crossing.
fn star(random: &mut Random, middle: DVec3, size: f64) -> Vec<Vec3> {
    let count = 3 + random.choice(9);
    let normal = random.direction();
    let (u, v) = normal.any_orthonormal_pair();
    let way = if random.next() < 0.5 { 1.0 } else { -1.0 };
    let vertices = (0..count).map(|i| {
        let angle = way * std::f64::consts::TAU * (i as f64 + random.between(0.0, 0.9)) / count as f64;
        let r = size * random.between(0.2, 1.0);
        middle + r * (angle.cos() * u + angle.sin() * v)
    });
    rounded(vertices.collect::<Vec<_>>())
}

fn straddling(random: &mut Random) -> Outline {
    let middle = random.direction() * random.ratio(0.1, 10.0);
    let size = random.ratio(0.1, 10.0);
    let ring = star(random, middle.with_z(0.3 * middle.z), size);
    Outline { rings: vec![ring], ..Outline::default() }
}

fn with_hole(random: &mut Random) -> Outline {
    let (center, u, v) = (2.0 * random.cube(), random.cube(), random.cube());
    let square = |s: f64| rounded([u + v, v - u, -u - v, u - v].map(|p| center + s * p));
    let hole = square(random.between(0.1, 0.9)).into_iter().rev().collect();
    Outline { rings: vec![square(1.0), hole], ..Outline::default() }
}

/// A vertex, an edge or the plane close to the origin.
fn contact(random: &mut Random) -> Outline {
    let ring = star(random, DVec3::ZERO, 1.0);
    let near = match random.choice(3) {
        0 => ring[0].as_dvec3(),
        1 => ring[0].as_dvec3().lerp(ring[1].as_dvec3(), random.next()),
        _ => random.between(0.0, 0.3) * ring[0].as_dvec3(),
    };
    let gap = random.direction() * random.ratio(1e-7, 1e-2);
    Outline { rings: vec![rounded(ring.iter().map(|v| v.as_dvec3() - near + gap))], ..Outline::default() }
}

/// Integer coordinates: vertices at z = 0, at the origin, twice, in a line, in planes through the origin.
fn lattice(random: &mut Random) -> Outline {
    let small = |random: &mut Random| random.choice(5) as f32 - 2.0;
    let [origin, u, v] = std::array::from_fn(|_| Vec3::new(small(random), small(random), small(random)));
    let count = 3 + random.choice(6);
    let ring = (0..count).map(|_| origin + small(random) * u + small(random) * v).collect();
    Outline { rings: vec![ring], ..Outline::default() }
}

fn sliver(random: &mut Random) -> Outline {
    let (center, u) = (random.direction() * random.ratio(0.1, 10.0), random.direction());
    let v = 1e-5 * random.direction();
    let ring = rounded([u + v, v - u, -u - v, u - v].map(|p| center + p));
    Outline { rings: vec![ring], ..Outline::default() }
}

fn huge(random: &mut Random) -> Outline {
    let middle = random.direction() * random.ratio(0.01, 1e6);
    Outline { rings: vec![star(random, middle, 1e6)], ..Outline::default() }
}

/// Worst error, and worst of those that an edge near the origin does not explain.
fn compare(name: &str, make: fn(&mut Random) -> Outline) {
    let gpu = CheckedGpu::open();
    let outlines: Vec<_> = (0..CASES).map(|i| make(&mut Random::new(i as u64))).collect();
    let (mut worst, mut worst_tame, mut sum, mut near) = (0.0_f64, 0.0_f64, 0.0, 0);
    for (outline, got) in outlines.iter().zip(polygons(&gpu, &outlines)) {
        let want = truth(outline);
        let error = (got - want).abs();
        let sensitive = sensitivity(outline);
        let allowed = ABSOLUTE + ROUNDING * sensitive;
        assert!(got.abs() <= 4.0, "{name}: {got}\n{outline:?}");
        // A jump by 1/2 or 1 goes through the origin there: either side is right.
        if ROUNDING * sensitive > 0.01 {
            near += 1;
            continue;
        }
        assert!(
            error <= allowed,
            "{name}: {got}, want {want}, error {error:e} over {allowed:e}\n{outline:?}"
        );
        worst = worst.max(error);
        if sensitive < 10.0 {
            worst_tame = worst_tame.max(error);
        }
        sum += error;
    }
    let mean = sum / CASES as f64;
    println!(
        "{name}: worst {worst:.1e}, {worst_tame:.1e} without near edges, mean {mean:.1e}; {near} through the origin"
    );
    gpu.finish();
}

#[test]
fn stars_across_the_horizon() {
    compare("stars", straddling);
}

#[test]
fn holes() {
    compare("holes", with_hole);
}

#[test]
fn contacts() {
    compare("contacts", contact);
}

#[test]
fn degenerate_outlines() {
    compare("lattice", lattice);
}

#[test]
fn slivers() {
    compare("slivers", sliver);
}

#[test]
fn huge_outlines() {
    compare("huge", huge);
}
