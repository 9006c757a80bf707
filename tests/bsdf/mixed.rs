//! Calls `glsl/probe/bsdf_mixed.comp`: materials of all models in one dispatch, the model known at run time only; and what
//! holds of their values there.

use amas::gpu::{Specialization, shaders};
use amas::reference::bsdf::Bsdf;
use amas::shared::{self, BsdfProbeRow};
use glam::{DVec3, Vec3};

use crate::common::gpu::CheckedGpu;
use crate::common::tables::{MODELS, values};
use crate::probe::{Case, Variant, eval};
use crate::random::{MODEL_NAMES, case, hostile};

/// What a function of the probe (`shared::BSDF_PROBE_*`) makes of each row.
pub(crate) fn ask(gpu: &CheckedGpu, function: u32, rows: &[BsdfProbeRow]) -> Vec<[f32; 4]> {
    let constants = Specialization::default().with(shared::SPEC_BSDF_PROBE, function);
    amas::probe::run(gpu, shaders::PROBE_BSDF_MIXED_COMP, &constants, rows).unwrap()
}

/// f of each case, and the density of sampling it.
pub(crate) fn eval_mixed(gpu: &CheckedGpu, function: u32, cases: &[Case]) -> Vec<(DVec3, f64)> {
    let rows: Vec<_> = cases.iter().map(Case::row).collect();
    let split = |v: [f32; 4]| (Vec3::from_slice(&v).as_dvec3(), f64::from(v[3]));
    ask(gpu, function, &rows).into_iter().map(split).collect()
}

/// `per_model` random cases of every model in turn.
pub(crate) fn mixed_cases(per_model: u32) -> Vec<Case> {
    (0..per_model).flat_map(|i| (0..MODEL_NAMES.len()).map(move |model| case(model, i))).collect()
}

/// The rule of the tables' README, with every row of the five tables in one dispatch.
#[test]
fn tables_of_all_models_in_one_dispatch() {
    let gpu = CheckedGpu::open();
    let (mut cases, mut wants) = (vec![], vec![]);
    for (name, column, bsdf) in MODELS {
        let table = values(name);
        for row in table.rows() {
            cases.push(Case::new(&bsdf(&row), row.raw_direction("wo"), row.raw_direction("wi")));
            let want = row.rgb(column);
            wants.push((row.place(), want, (5e-6 + 128.0 * row.get("cond")) * want.abs() + 1e-9));
        }
    }
    let mut worst: f64 = 0.0;
    let got = eval_mixed(&gpu, shared::BSDF_PROBE_EVAL, &cases);
    for ((case, (place, want, allowed)), (got, _)) in cases.iter().zip(&wants).zip(got) {
        let share = (got - want).abs() / *allowed;
        assert!(share.cmple(DVec3::ONE).all(), "{place}: {case}\n  got {got:?}\n  want {want:?}");
        worst = worst.max(share.max_element());
    }
    println!("{} rows of five models, worst at {worst:.3} of the rule", cases.len());
    gpu.finish();
}

/// The run-time model runs the arithmetic of the compiled one.
#[test]
fn a_model_known_at_run_time_is_the_compiled_one() {
    let gpu = CheckedGpu::open();
    let mut cases = mixed_cases(8_000);
    cases.extend((0..8_000).flat_map(|i| (0..5).map(move |model| hostile(model, i))));
    let compiled = eval(&gpu, &cases, Variant::general);
    let mixed = eval_mixed(&gpu, shared::BSDF_PROBE_EVAL, &cases);
    for ((case, want), (got, pdf)) in cases.iter().zip(compiled).zip(mixed) {
        let error = (got - want).abs();
        assert!(error.cmple(1e-6 * want.abs()).all(), "{case}\n  got {got:?}\n  want {want:?}");
        let lit = case.wo.z > 0.0 && case.wi.z > 0.0;
        let possible = if lit { pdf > 0.0 && pdf.is_finite() } else { pdf == 0.0 };
        assert!(possible, "{case}\n  density {pdf}");
    }
    gpu.finish();
}

#[test]
fn lambertian_share() {
    let gpu = CheckedGpu::open();
    let cases = mixed_cases(4_000);
    let rows: Vec<_> = cases.iter().map(Case::row).collect();
    for (case, got) in cases.iter().zip(ask(&gpu, shared::BSDF_PROBE_LAMBERT, &rows)) {
        let (got, want) = (Vec3::from_slice(&got).as_dvec3(), lambert(&case.bsdf));
        assert!((got - want).abs().max_element() <= 3e-7, "{case}\n  got {got}\n  want {want}");
    }
    gpu.finish();
}

fn lambert(bsdf: &Bsdf) -> DVec3 {
    match bsdf {
        Bsdf::Matte(m) => {
            let sigma2 = m.sigma.to_radians().powi(2);
            m.color * (1.0 - sigma2 / (2.0 * (sigma2 + 0.33)))
        }
        Bsdf::Plastic(m) => m.diffuse,
        Bsdf::Metal(_) => DVec3::ZERO,
        Bsdf::Substrate(m) => m.diffuse * (DVec3::ONE - m.specular),
        Bsdf::Principled(m) => m.base_color * (1.0 - m.metallic),
    }
}

/// Materials through the ten words and back, the model with them.
#[test]
fn packed_materials_keep_f() {
    let gpu = CheckedGpu::open();
    let cases = mixed_cases(40_000);
    let exact = eval_mixed(&gpu, shared::BSDF_PROBE_EVAL, &cases);
    let packed = eval_mixed(&gpu, shared::BSDF_PROBE_PACKED, &cases);
    let mut worst = [0.0_f64; 5];
    for (i, ((case, (want, _)), (got, _))) in cases.iter().zip(exact).zip(packed).enumerate() {
        let relative = (got - want).abs() / (want.abs() + 1e-30);
        let error = relative.max_element();
        assert!(error <= 2e-3, "{case}\n  got {got:?}\n  want {want:?}\n  relative error {error:.2e}");
        worst[i % 5] = worst[i % 5].max(error);
    }
    for (model, worst) in MODEL_NAMES.into_iter().zip(worst) {
        println!("{model}: f within {worst:.1e} of itself, relative");
    }
    gpu.finish();
}
