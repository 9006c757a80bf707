//! The device against the double-precision oracle, over a low-discrepancy grid with its corners.

use amas::reference::bsdf::Bsdf;
use glam::DVec3;

use crate::common::gpu::CheckedGpu;
use crate::probe::{Case, Variant, eval};
use crate::random::{MODEL_NAMES, case};

/// 64 roundings of float32. Measured on lavapipe: 1.5e-6.
const ARITHMETIC: f64 = 4e-6;

#[test]
fn device_and_oracle_agree() {
    let gpu = CheckedGpu::open();
    for (model, name) in MODEL_NAMES.into_iter().enumerate() {
        let cases = (0..20_000).map(|i| case(model, i));
        let cases: Vec<_> = cases.filter(|case| !singular(&case.bsdf)).collect();
        for (choice, choose) in Variant::CHOICES {
            let mut worst: f64 = 0.0;
            for (case, got) in cases.iter().zip(eval(&gpu, &cases, choose)) {
                worst = worst.max(share(case, got).unwrap_or_else(|e| panic!("{name}, {choice}: {e}")));
            }
            println!("{name}, {choice}: worst at {worst:.3} of the bound");
        }
    }
    gpu.finish();
}

/// The share of the bound that the error takes.
fn share(case: &Case, got: DVec3) -> Result<f64, String> {
    let want = case.oracle();
    let error = (got - want).abs();
    let share = error / (ARITHMETIC * want + input_rounding(case, want) + 1e-12);
    if share.cmple(DVec3::ONE).all() {
        return Ok(share.max_element());
    }
    let relative = error / want;
    Err(format!(
        "{case}\n  got {got:?}\n  want {want:?}\n  relative error {relative:?}, share of the bound {share:?}"
    ))
}

/// What float32's directions cost before any arithmetic: f of their lengths as they are against f of unit ones, and
/// what it moves by when each component moves by half a unit in its last place.
fn input_rounding(case: &Case, want: DVec3) -> DVec3 {
    let raw = |case: &Case| case.bsdf.eval(case.wo, case.wi);
    let here = raw(case);
    let moves = (0..6).map(|axis| {
        let mut moved = *case;
        let direction = if axis < 3 { &mut moved.wo } else { &mut moved.wi };
        direction[axis % 3] *= 1.0 + f64::from(f32::EPSILON) / 2.0;
        (raw(&moved) - here).abs()
    });
    (here - want).abs() + moves.sum::<DVec3>()
}

/// A metal that reflects by an index near 0 without absorbing: at normal incidence its Fresnel term is a root of
/// eta² − sin²θ, of which float32 keeps no digit. No metal is like that, and the values are still finite.
fn singular(bsdf: &Bsdf) -> bool {
    match bsdf {
        Bsdf::Metal(m) => m.eta.cmplt(DVec3::splat(0.05)).any() && m.k.cmplt(DVec3::splat(0.05)).any(),
        _ => false,
    }
}
