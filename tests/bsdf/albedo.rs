//! Directional albedos of the device's values, two-sided: one that is too low is as wrong as one that is too high.

use amas::reference::bsdf::{Bsdf, Ggx};
use glam::DVec3;

use crate::common::albedo::{figures, quadrature, white_metal};
use crate::common::gpu::CheckedGpu;
use crate::common::tables::{MODELS, albedos};
use crate::probe::{Case, Variant, eval};

/// Against 2^17 points, 2^15 of each strategy are off by at most 1.1e-4, at alpha from 1e-3 to 1; the tables by 8e-5.
const POINTS: u32 = 1 << 15;

/// At most about so many figures of a model: every one of the subset, a part of the complete tables.
const FIGURES: usize = 32;

#[test]
fn albedos_of_the_tables() {
    let gpu = CheckedGpu::open();
    for (model, ..) in MODELS {
        let figures = figures(model, &albedos(model));
        let step = figures.len().div_ceil(FIGURES);
        let mut worst: f64 = 0.0;
        for figure in figures.iter().step_by(step) {
            let got = albedo(&gpu, &figure.bsdf, figure.wo);
            let error = (got - figure.want).abs().max_element();
            assert!(error <= 1e-3, "{figure}: got {got}");
            worst = worst.max(error);
        }
        println!(
            "{model}: {} albedos within {worst:.1e}",
            figures.len().div_ceil(step)
        );
    }
    gpu.finish();
}

#[test]
fn furnace_of_the_roughest_metal_has_a_closed_form() {
    let gpu = CheckedGpu::open();
    let got = albedo(&gpu, &white_metal(Ggx::isotropic(1.0)), DVec3::Z);
    let want = 1.0 - std::f64::consts::LN_2;
    assert!(
        (got - want).abs().max_element() < 1e-4,
        "{got} against {want}"
    );
    gpu.finish();
}

fn albedo(gpu: &CheckedGpu, bsdf: &Bsdf, wo: DVec3) -> DVec3 {
    let place = |wi: DVec3| wi.as_vec3().as_dvec3();
    let points = quadrature(bsdf, wo, POINTS, place);
    let cases: Vec<_> = points
        .iter()
        .map(|&(wi, _)| Case::new(bsdf, wo, wi))
        .collect();
    let values = eval(gpu, &cases, Variant::trimmed);
    points
        .iter()
        .zip(values)
        .map(|(&(_, weight), f)| f * weight)
        .sum()
}
