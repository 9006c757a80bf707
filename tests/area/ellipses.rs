//! Disks and ellipses: T7, and random ones of every kind against quadrature in double precision and a 4,096-gon.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::probe::{Ellipse, ellipses};
use crate::truth::{self, Random};

fn disk(offset: f32, height: f32, radius: f32) -> Ellipse {
    Ellipse { center: vec3(offset, 0.0, height), a: Vec3::X * radius, b: Vec3::Y * radius }
}

/// A disk at height h, radius R and offset a from the normal, parallel to the surface.
fn parallel(offset: f64, h: f64, radius: f64) -> f64 {
    let [a2, h2, r2] = [offset, h, radius].map(|x| x * x);
    // ½ (1 − (h² + a² − r²) / √((h² + a² + r²)² − 4 a² r²)), without the cancellation of small disks.
    let root = ((h2 + a2 + r2).powi(2) - 4.0 * a2 * r2).sqrt();
    2.0 * h2 * r2 / (root * (root + h2 + a2 - r2))
}

#[test]
fn parallel_disks() {
    let gpu = CheckedGpu::open();
    let known = [
        (0.0, 1.0, 1.0, 0.5),
        (0.0, 2.0, 1.0, 0.2),
        (0.0, 1.0, 0.1, 0.009_900_990),
        (0.0, 1.0, 10.0, 0.990_099_010),
        (1.0, 1.0, 1.0, 0.276_393_202),
        (2.0, 1.0, 1.0, 0.052_786_405),
    ];
    let disks: Vec<_> = known.iter().map(|&(a, h, r, _)| disk(a, h, r)).collect();
    for ((a, h, r, want), got) in known.into_iter().zip(ellipses(&gpu, &disks)) {
        let exact = parallel(f64::from(a), f64::from(h), f64::from(r));
        println!("T7 R = {r}, h = {h}, a = {a}: {got:.9}, error {:.1e}", (got - exact).abs());
        assert!((exact - want).abs() < 1e-9 && (got - exact).abs() < 1e-6, "{got} {exact} {want}");
    }
    // Any size, and any distance from the rim: relative to what the surface receives.
    let mut random = Random::new(1);
    let cases: Vec<_> = (0..20_000)
        .map(|_| {
            let (h, r) = (random.ratio(1e-3, 1e3) as f32, random.ratio(1e-5, 1e5) as f32);
            (random.between(0.0, 2.0) as f32 * r.max(h), h, h * r)
        })
        .collect();
    let disks: Vec<_> = cases.iter().map(|&(a, h, r)| disk(a, h, r)).collect();
    let mut worst: f64 = 0.0;
    for (&(a, h, r), got) in cases.iter().zip(ellipses(&gpu, &disks)) {
        let want = parallel(f64::from(a), f64::from(h), f64::from(r));
        let error = (got - want).abs();
        // The rim at relative distance x turns a rounding into one over x of it.
        let rim = f64::from(((a - r).abs() + h) / r.max(a));
        assert!(error <= (1e-5 + 2e-7 / rim) * want, "R {r} h {h} a {a}: {got:e} {want:e}");
        worst = worst.max(error / want);
    }
    println!("parallel disks: worst relative error {worst:.1e}");
    gpu.finish();
}

struct Kind {
    name: &'static str,
    make: fn(&mut Random) -> [DVec3; 3],
    worst: f64,
    mean: f64,
}

fn circle(random: &mut Random, distance: f64) -> [DVec3; 3] {
    let normal = random.direction();
    let (a, b) = normal.any_orthonormal_pair();
    [distance * random.direction(), a, b]
}

fn skewed(random: &mut Random, distance: f64) -> [DVec3; 3] {
    [distance * random.direction(), random.cube(), random.cube()]
}

/// At a height over the plane of the ellipse, relative to the outline at `at` of the way from its middle.
fn close(random: &mut Random, at: f64) -> [DVec3; 3] {
    let (a, b) = (random.cube(), random.cube());
    let (psi, height) = (random.between(0.0, TAU), random.ratio(1e-4, 1e-1));
    [at * (psi.cos() * a + psi.sin() * b) + height * a.cross(b).normalize(), a, b]
}

const KINDS: [Kind; 7] = [
    Kind {
        name: "circles",
        make: |r| {
            let d = r.ratio(0.1, 10.0);
            circle(r, d)
        },
        worst: 2e-6,
        mean: 1e-7,
    },
    Kind {
        name: "ellipses",
        make: |r| {
            let d = r.ratio(0.1, 10.0);
            skewed(r, d)
        },
        worst: 5e-5,
        mean: 1e-7,
    },
    Kind {
        name: "thin",
        make: |r| {
            let d = r.ratio(0.1, 10.0);
            let [c, a, b] = skewed(r, d);
            [c, a, 1e-3 * b]
        },
        worst: 2e-6,
        mean: 1e-8,
    },
    Kind {
        name: "tiny",
        make: |r| {
            let [c, a, b] = skewed(r, 1.0);
            [c, 1e-5 * a, 1e-5 * b]
        },
        worst: 1e-15,
        mean: 1e-16,
    },
    Kind {
        name: "huge",
        make: |r| {
            let [c, a, b] = skewed(r, 1.0);
            [c, 1e6 * a, 1e6 * b]
        },
        worst: 2e-3,
        mean: 1e-6,
    },
    Kind {
        name: "close",
        make: |r| {
            let at = r.between(0.0, 2.0);
            close(r, at)
        },
        worst: 5e-5,
        mean: 3e-7,
    },
    Kind {
        name: "at the rim",
        make: |r| {
            let at = 1.0 + (r.next() - 0.5).signum() * r.ratio(1e-4, 0.1);
            close(r, at)
        },
        worst: 1e-3,
        mean: 1e-5,
    },
];

#[test]
fn random_ellipses() {
    let gpu = CheckedGpu::open();
    for kind in KINDS {
        let all: Vec<_> = (0..100_000)
            .map(|i| {
                let [center, a, b] = (kind.make)(&mut Random::new(i)).map(|v| v.as_vec3());
                Ellipse { center, a, b }
            })
            .collect();
        let got = ellipses(&gpu, &all);
        let bad = got.iter().position(|&e| !(0.0..=1.0 + 1e-5).contains(&e));
        assert_eq!(bad, None, "{}: {:?}", kind.name, bad.map(|i| (got[i], all[i])));
        // Quadrature is slow: every twentieth one.
        let (mut sums, mut worst, mut relative) = ([(0.0, 0); 2], [0.0_f64; 2], 0.0_f64);
        for (ellipse, got) in all.iter().zip(got).step_by(20) {
            let want = truth::ellipse(ellipse);
            let straddles =
                usize::from(f64::from(ellipse.center.z).abs() < f64::from(ellipse.a.z.hypot(ellipse.b.z)));
            let error = (got - want).abs();
            sums[straddles] = (sums[straddles].0 + error, sums[straddles].1 + 1);
            assert!(error <= kind.worst, "{}: {ellipse:?}: {got:e}, want {want:e}", kind.name);
            worst[straddles] = worst[straddles].max(error);
            if straddles == 0 && want > 0.0 {
                relative = relative.max(error / want);
            }
        }
        let mean = sums.map(|(sum, count)| sum / f64::from(count.max(1)));
        println!(
            "{}: above worst {:.1e} mean {:.1e} relative {relative:.1e}; across the horizon worst {:.1e} mean {:.1e}",
            kind.name, worst[0], mean[0], worst[1], mean[1]
        );
        assert!(mean[0].max(mean[1]) <= kind.mean, "{}: {mean:?}", kind.name);
    }
    gpu.finish();
}

/// Disks as outlines of 4,096 corners, across the horizon and not.
#[test]
fn polygons_of_many_corners() {
    let gpu = CheckedGpu::open();
    let all: Vec<_> = (0..2_000)
        .map(|i| {
            let mut random = Random::new(i);
            let distance = random.ratio(1.5, 10.0);
            let [center, a, b] = circle(&mut random, distance).map(|v| v.as_vec3());
            Ellipse { center, a, b }
        })
        .collect();
    let mut worst: f64 = 0.0;
    for (ellipse, got) in all.iter().zip(ellipses(&gpu, &all)) {
        let corners: Vec<_> = (0..4096).map(|i| ellipse.point(TAU * f64::from(i) / 4096.0)).collect();
        // Inscribed: smaller by 4e-7 of it.
        let error = (got - truth::ring(&corners).abs()).abs();
        assert!(error < 1e-6, "{ellipse:?}: {got}, {error:e}");
        worst = worst.max(error);
    }
    println!("4,096-gons: worst {worst:.1e}");
    gpu.finish();
}
