//! An ellipse by azimuth: ranges and intervals against points of it, and against its form factor.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec2};

use crate::common::gpu::CheckedGpu;
use crate::probe::{Ellipse, azimuths, ellipses, intervals};
use crate::truth::Random;

fn random_ellipses(count: u64) -> Vec<Ellipse> {
    let make = |i| {
        let mut random = Random::new(i);
        let center = random.direction() * random.ratio(0.05, 5.0);
        let size = random.ratio(1e-3, 2.0);
        let [a, b]: [DVec3; 2] = std::array::from_fn(|_| size * random.cube());
        Ellipse { center: center.as_vec3(), a: a.as_vec3(), b: b.as_vec3() }
    };
    (0..count).map(make).collect()
}

/// Every point of the outline lies within the azimuths, and some at either end.
#[test]
fn azimuths_hold_the_outline() {
    let gpu = CheckedGpu::open();
    let all = random_ellipses(20_000);
    let mut worst: f64 = 0.0;
    for (ellipse, (middle, half)) in all.iter().zip(azimuths(&gpu, &all)) {
        assert!((middle.length() - 1.0).abs() < 1e-6 && half >= 0.0, "{ellipse:?}: {middle} {half}");
        if half >= PI {
            continue;
        }
        let (mut from, mut to) = (0.0_f64, 0.0_f64);
        for i in 0..2048 {
            let p = ellipse.point(TAU * f64::from(i) / 2048.0).truncate();
            let angle = middle.perp_dot(p).atan2(middle.dot(p));
            (from, to) = (from.min(angle), to.max(angle));
        }
        // The ends are parabolas: a step of 1/2048 of the turn misses up to 1e-6 of them, more where a point is near.
        let near = (0..256).map(|i| ellipse.point(TAU * f64::from(i) / 256.0).truncate().length());
        let near = near.fold(f64::INFINITY, f64::min);
        let size = f64::from(ellipse.a.length() + ellipse.b.length());
        let allowed = 1e-6 + 2e-5 * size / near + 1e-6 * f64::from(ellipse.center.length()) / near;
        let error = (half - to).abs().max((half + from).abs());
        assert!(
            error <= allowed || near < 0.01 * size,
            "{ellipse:?}: {half} {from} {to}, {error:e} {allowed:e}"
        );
        if near > size {
            worst = worst.max(error);
        }
    }
    println!("azimuths: worst {worst:.1e} where the axis is farther than the size");
    gpu.finish();
}

/// ∫ cos θ over the intervals above the horizon is the form factor.
#[test]
fn intervals_sum_to_the_form_factor() {
    let gpu = CheckedGpu::open();
    const STEPS: u32 = 512;
    let all: Vec<_> = random_ellipses(400);
    let ranges = azimuths(&gpu, &all);
    let want = ellipses(&gpu, &all);
    let mut rows = vec![];
    for (ellipse, &(middle, half)) in all.iter().zip(&ranges) {
        for i in 1..=STEPS {
            // Chebyshev's second kind: x = cos t, weight sin² t / √(1 − x²).
            let t = PI * f64::from(i) / f64::from(STEPS + 1);
            let x = if half >= PI { f64::from(2 * i) / f64::from(STEPS) - 1.0 } else { t.cos() };
            let e = DVec2::from_angle(half * x).rotate(middle);
            rows.push((*ellipse, e.as_vec2()));
        }
    }
    let found = intervals(&gpu, &rows);
    let (mut worst, mut sum): (f64, f64) = (0.0, 0.0);
    for (k, ((ellipse, &(_, half)), want)) in all.iter().zip(&ranges).zip(want).enumerate() {
        let mut total = 0.0;
        for i in 1..=STEPS {
            let interval = found[k * STEPS as usize + i as usize - 1];
            assert!(
                interval.lower >= -1.0 - 1e-6 && interval.upper <= 1.0 + 1e-6,
                "{ellipse:?} {interval:?}"
            );
            assert_eq!(interval.contains.iter().any(|&c| c), half >= PI, "{ellipse:?}");
            let t = PI * f64::from(i) / f64::from(STEPS + 1);
            let weight =
                if half >= PI { TAU / f64::from(STEPS) } else { half * PI / f64::from(STEPS + 1) * t.sin() };
            let [lower, upper] = [interval.lower, interval.upper].map(|cosine| cosine.max(0.0));
            if upper > lower {
                total += weight * (upper - lower) * (upper + lower) / TAU;
            }
        }
        let error = (total - want).abs();
        assert!(error < 2e-3, "{ellipse:?}: {total}, form factor {want}");
        worst = worst.max(error);
        sum += error;
    }
    println!("intervals: worst {worst:.1e}, mean {:.1e} with {STEPS} azimuths", sum / all.len() as f64);
    gpu.finish();
}

/// Points of the ellipse lie in the interval of their azimuth, points beside it do not.
#[test]
fn intervals_hold_the_ellipse() {
    let gpu = CheckedGpu::open();
    let all = random_ellipses(50_000);
    let point = |ellipse: &Ellipse, i: usize, scale: f64| {
        let mut random = Random::new(i as u64 + 7);
        let (psi, r) = (TAU * random.next(), scale * random.next().sqrt());
        let center = ellipse.center.as_dvec3();
        center + r * (ellipse.point(psi) - center)
    };
    let azimuth = |p: DVec3| -> Vec2 { p.truncate().normalize().as_vec2() };
    let rows: Vec<_> =
        all.iter().enumerate().map(|(i, ellipse)| (*ellipse, azimuth(point(ellipse, i, 0.999)))).collect();
    for (i, interval) in intervals(&gpu, &rows).into_iter().enumerate() {
        let p = point(&all[i], i, 0.999);
        let cosine = p.normalize().z;
        // A rounding of the azimuth moves a chord that is seen from close by.
        let slack = 3e-6 + 1e-6 * all[i].center.as_dvec3().length() / p.length();
        let inside = interval.lower - slack <= cosine && cosine <= interval.upper + slack;
        assert!(inside, "{:?}: {cosine} not in {interval:?}", rows[i]);
    }
    gpu.finish();
}
