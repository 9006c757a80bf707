//! The oracle's BSDFs against pbrt-v3 in double precision, and against the laws that every BSDF obeys.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod common;

use amas::reference::bsdf::{Bsdf, Ggx, Principled};
use common::albedo::{albedo, at_cosine, figures, r2, white_metal, white_principled};
use common::tables::{MODELS, albedos, values};
use glam::DVec3;
use rayon::prelude::*;

#[test]
fn every_row_of_the_tables() {
    for (model, column, bsdf) in MODELS {
        let table = values(model);
        let mut worst: f64 = 0.0;
        for row in table.rows() {
            let got = bsdf(&row).eval(row.direction("wo"), row.direction("wi"));
            let want = row.rgb(column);
            for (got, want) in got.to_array().into_iter().zip(want.to_array()) {
                let error = (got - want).abs();
                worst = worst.max((error - 1e-12).max(0.0) / want.abs().max(1e-300));
                assert!(error <= 1e-6 * want.abs() + 1e-12, "{}: got {got:e}, want {want:e}", row.place());
            }
        }
        println!("{}: worst relative error {worst:.1e}", table.name);
    }
}

#[test]
fn reciprocity() {
    for (model, _, bsdf) in MODELS {
        let table = values(model);
        for row in table.rows() {
            let (wo, wi, bsdf) = (row.direction("wo"), row.direction("wi"), bsdf(&row));
            let (there, back) = (bsdf.eval(wo, wi), bsdf.eval(wi, wo));
            let scale = there.max_element().max(1e-300);
            assert!(
                (there - back).abs().max_element() <= 1e-12 * scale,
                "{}: {there} against {back}",
                row.place()
            );
        }
    }
}

/// Two-sided: an albedo that is too low is as wrong as one that is too high.
#[test]
fn albedos_of_the_tables() {
    for (model, ..) in MODELS {
        figures(model, &albedos(model)).par_iter().for_each(|figure| {
            // Off by at most 3.7e-4, against 2^17 points.
            let got = albedo(&figure.bsdf, figure.wo, 1 << 14);
            let error = (got - figure.want).abs().max_element();
            assert!(error <= 1e-3, "{figure}: got {got}");
        });
    }
}

#[test]
fn furnace_of_the_roughest_metal_has_a_closed_form() {
    let got = albedo(&white_metal(Ggx::isotropic(1.0)), DVec3::Z, 1 << 18).x;
    let want = 1.0 - std::f64::consts::LN_2;
    assert!((got - want).abs() < 2e-5, "{got} against {want}");
}

#[test]
fn sampling_density_integrates_to_the_share_above_the_surface() {
    // Directions that are sampled below the surface are lost: what is left is the density's integral above it.
    let bsdf = Bsdf::Principled(Principled { clearcoat: 1.0, ..white_principled(0.5, 0.0) });
    let (n, wo) = (1 << 18, at_cosine(0.6, 30.0));
    let uniform = |i| {
        let xi = r2(i);
        bsdf.pdf(wo, at_cosine(xi.x, 360.0 * xi.y)) * std::f64::consts::TAU
    };
    let integral = (0..n).map(uniform).sum::<f64>() / f64::from(n);
    let above = (0..n).filter(|&i| bsdf.sample(wo, r2(i)).z > 0.0);
    let share = above.count() as f64 / f64::from(n);
    assert!((integral - share).abs() < 1e-3, "{integral} against {share}");
}
