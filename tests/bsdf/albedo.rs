//! Directional albedos of the device's values, two-sided: one that is too low is as wrong as one that is too high.

use std::collections::BTreeSet;

use amas::reference::bsdf::{Bsdf, Ggx};
use glam::DVec3;

use crate::common::albedo::{figures, quadrature, white_metal};
use crate::common::gpu::CheckedGpu;
use crate::common::tables::{MODELS, albedos};
use crate::probe::{Case, Variant, eval};

/// Against 2^17 points, 2^15 of each strategy are off by at most 1.1e-4, at alpha from 1e-3 to 1; the tables by 8e-5.
const POINTS: u32 = 1 << 15;

/// Figures of a model: all of a short table, or so many of a long one, spread over its roughnesses and angles.
const FIGURES: usize = 40;

#[test]
fn albedos_of_the_tables() {
    let gpu = CheckedGpu::open();
    for (model, ..) in MODELS {
        let figures = figures(model, &albedos(model));
        let (mut worst, mut angles): (f64, BTreeSet<u64>) = (0.0, BTreeSet::new());
        let chosen = spread(figures.len());
        for figure in chosen.iter().map(|&i| &figures[i]) {
            let got = albedo(&gpu, &figure.bsdf, figure.wo);
            let error = (got - figure.want).abs().max_element();
            assert!(error <= 1e-3, "{figure}: got {got}");
            worst = worst.max(error);
            angles.insert(figure.wo.z.to_bits());
        }
        assert!(chosen.len() >= 12 && angles.len() >= 4, "{model}: too few figures");
        let (n, angles) = (chosen.len(), angles.len());
        println!("{model}: {n} albedos, {angles} view angles, within {worst:.1e}");
    }
    gpu.finish();
}

/// A share of the indices below `count` by the golden ratio, which keeps step with no period of a table.
pub(crate) fn spread(count: usize) -> BTreeSet<usize> {
    if count <= FIGURES {
        return (0..count).collect();
    }
    let golden = (0..FIGURES).map(|i| (i as f64 * 0.618_033_988_749_895).fract());
    golden.map(|x| (x * count as f64) as usize).collect()
}

#[test]
fn furnace_of_the_roughest_metal_has_a_closed_form() {
    let gpu = CheckedGpu::open();
    let got = albedo(&gpu, &white_metal(Ggx::isotropic(1.0)), DVec3::Z);
    let want = 1.0 - std::f64::consts::LN_2;
    assert!((got - want).abs().max_element() < 1e-4, "{got} against {want}");
    gpu.finish();
}

fn albedo(gpu: &CheckedGpu, bsdf: &Bsdf, wo: DVec3) -> DVec3 {
    let place = |wi: DVec3| wi.as_vec3().as_dvec3();
    let points = quadrature(bsdf, wo, POINTS, place);
    let cases: Vec<_> = points.iter().map(|&(wi, _)| Case::new(bsdf, wo, wi)).collect();
    let values = eval(gpu, &cases, Variant::trimmed);
    points.iter().zip(values).map(|(&(_, weight), f)| f * weight).sum()
}
