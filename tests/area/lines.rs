//! Lines: the outline of an open cylinder against its surface in double precision, against the oracle, and T9.

use amas::reference::area::{Emitter, reflected};
use amas::reference::bsdf::{Bsdf, Matte};
use amas::reference::shading::{Frame, Surface};
use amas::scene::{AreaLight, AreaShape};
use glam::{DVec3, Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::probe::{Cylinder, cylinders};
use crate::truth::{self, Random};

/// Radius over distance to the axis between the bounds.
fn random_cylinder(random: &mut Random, low: f64, high: f64) -> Cylinder {
    let a = random.direction() * random.ratio(0.3, 5.0);
    let b = a + random.direction() * random.ratio(0.1, 10.0);
    let axis = (b - a).normalize();
    let d = (a - axis * a.dot(axis)).length();
    let radius = d * random.between(low, high);
    Cylinder { a: a.as_vec3(), b: b.as_vec3(), radius: radius as f32 }
}

#[test]
fn thin_lines() {
    let gpu = CheckedGpu::open();
    let line = |half: f32, radius| Cylinder { a: vec3(-half, 0.0, 1.0), b: vec3(half, 0.0, 1.0), radius };
    // The closed forms are limits of no radius, from which a cylinder differs by .3 of radius over height.
    for (what, cylinder, want) in [
        ("T9 length 2", line(1.0, 0.01), 0.008_183_099),
        ("T9 long", line(1e4, 0.01), 0.01),
        ("T9 thin", line(1.0, 1e-4), 0.000_081_830_99),
    ] {
        let got = cylinders(&gpu, &[cylinder])[0];
        println!("{what}: {got:.9}, want {want:.9}");
        let ratio = f64::from(cylinder.radius);
        assert!((got / want - 1.0).abs() < 1e-5 + 0.35 * ratio, "{what}: {got}, want {want}");
    }
    gpu.finish();
}

#[test]
fn cylinders_of_any_radius() {
    let gpu = CheckedGpu::open();
    for (low, high, worst_allowed, mean_allowed) in
        [(0.0, 0.1, 5e-5, 3e-6), (0.1, 0.3, 1e-3, 5e-5), (0.3, 0.6, 5e-3, 3e-4), (0.6, 0.9, 1.5e-2, 1e-3)]
    {
        let all: Vec<_> = (0..150).map(|i| random_cylinder(&mut Random::new(i), low, high)).collect();
        let (mut worst, mut sum, mut total): (f64, f64, f64) = (0.0, 0.0, 0.0);
        for (cylinder, got) in all.iter().zip(cylinders(&gpu, &all)) {
            let want = truth::cylinder(cylinder);
            worst = worst.max((got - want).abs());
            sum += (got - want).abs();
            total += want;
        }
        let (mean, relative) = (sum / all.len() as f64, sum / total);
        println!(
            "radius {low}–{high} of the distance: worst {worst:.1e}, mean {mean:.1e}, relative {relative:.1e}"
        );
        assert!(worst < worst_allowed && mean < mean_allowed, "{worst:e} {mean:e}");
    }
    gpu.finish();
}

/// The oracle's own line light, under which a white surface reflects the form factor.
#[test]
fn the_oracle_agrees() {
    let gpu = CheckedGpu::open();
    let surface = Surface {
        position: DVec3::ZERO,
        frame: Frame { tangent: DVec3::X, bitangent: DVec3::Y, normal: DVec3::Z },
        wo: DVec3::Z,
        bsdf: Bsdf::Matte(Matte { color: DVec3::ONE, sigma: 0.0 }),
    };
    let all: Vec<_> = (0..40).map(|i| random_cylinder(&mut Random::new(1000 + i), 0.01, 0.9)).collect();
    let mut worst: f64 = 0.0;
    for cylinder in &all {
        let Cylinder { a, b, radius } = *cylinder;
        let shape = AreaShape::Line { a, b, radius };
        let light = AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible: false, texture: None };
        let estimate = reflected(&surface, &[Emitter::new(&light, &[])], 1e-4, 3);
        let want = truth::cylinder(cylinder);
        let error = (estimate.value.x - want).abs();
        assert!(error <= 6.0 * estimate.standard_error.x + 1e-6, "{cylinder:?}: {estimate:?}, {want}");
        worst = worst.max(error);
    }
    println!("the oracle and the quadrature differ by at most {worst:.1e}");
    gpu.finish();
}

#[test]
fn hostile_lines() {
    let gpu = CheckedGpu::open();
    let mut random = Random::new(5);
    let mut all: Vec<_> = (0..100_000)
        .map(|_| {
            let mut cylinder = random_cylinder(&mut random, 0.0, 1.0);
            let a = cylinder.a.as_dvec3();
            let axis = (cylinder.b.as_dvec3() - a).normalize();
            let d = (a - axis * a.dot(axis)).length();
            // On the surface to 1e-7, or of any radius.
            cylinder.radius = (d * (1.0 - random.ratio(1e-9, 1.0))) as f32;
            cylinder
        })
        .collect();
    // Inside, on the axis, without length or radius.
    let inside = all.len();
    all.extend([
        Cylinder { a: vec3(-1.0, 0.0, 0.1), b: vec3(1.0, 0.0, 0.1), radius: 0.2 },
        Cylinder { a: vec3(1.0, 0.0, 0.1), b: vec3(2.0, 0.0, 0.1), radius: 0.2 },
        Cylinder { a: Vec3::X, b: 2.0 * Vec3::X, radius: 0.1 },
        Cylinder { a: Vec3::Z, b: Vec3::Z, radius: 0.1 },
        Cylinder { a: Vec3::Z, b: Vec3::ONE, radius: 0.0 },
    ]);
    for (i, got) in cylinders(&gpu, &all).into_iter().enumerate() {
        assert!((-1e-6..=1.0 + 1e-6).contains(&got), "{:?}: {got}", all[i]);
        assert!(i < inside || got == 0.0, "{:?}: {got}", all[i]);
    }
    gpu.finish();
}
