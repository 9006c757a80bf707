//! What holds for every BSDF: Helmholtz reciprocity, and values that are finite and not negative.

use glam::DVec3;

use crate::common::gpu::CheckedGpu;
use crate::probe::{Case, Variant, eval};
use crate::random::{MODEL_NAMES, case, hostile};

/// Swapping the directions leaves the half vector alone, so only the rounding of visibility and of cosines differs.
const RECIPROCITY: f64 = 1e-5;

#[test]
fn reciprocity() {
    let gpu = CheckedGpu::open();
    for (model, name) in MODEL_NAMES.into_iter().enumerate() {
        let cases: Vec<_> = (0..40_000).map(|i| case(model, i)).collect();
        let swapped: Vec<_> = cases.iter().map(|case| case.swapped()).collect();
        let there = eval(&gpu, &cases, Variant::general);
        let back = eval(&gpu, &swapped, Variant::general);
        let mut worst: f64 = 0.0;
        for ((case, there), back) in cases.iter().zip(there).zip(back) {
            let relative = ((there - back).abs() / there.max(back).max(DVec3::splat(1e-30))).max_element();
            assert!(
                relative <= RECIPROCITY,
                "{name}: {case}\n  f {there:?}\n  swapped {back:?}\n  relative error {relative:.2e}"
            );
            worst = worst.max(relative);
        }
        println!("{name}: reciprocal to {worst:.1e}");
    }
    gpu.finish();
}

#[test]
fn no_value_is_negative_or_not_finite() {
    let gpu = CheckedGpu::open();
    for (model, name) in MODEL_NAMES.into_iter().enumerate() {
        let mut cases: Vec<_> = (0..120_000).map(|i| case(model, i)).collect();
        cases.extend((0..120_000).map(|i| hostile(model, i)));
        for (_, choose) in Variant::CHOICES {
            for (case, f) in cases.iter().zip(eval(&gpu, &cases, choose)) {
                require_radiometric(name, case, f);
            }
        }
    }
    gpu.finish();
}

fn require_radiometric(name: &str, case: &Case, f: DVec3) {
    assert!(f.is_finite() && f.min_element() >= 0.0, "{name}: {case}\n  f {f:?}");
    let lit = case.wo.z > 0.0 && case.wi.z > 0.0;
    assert!(lit || f == DVec3::ZERO, "{name}: {case}\n  f {f:?} below the surface");
}
