//! The oracle's BSDFs against pbrt-v3 in double precision, and against the laws that every BSDF obeys.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod common;

use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use common::{MODELS, Row, Table, albedo, at_cosine, table_folders};
use glam::DVec3;

#[test]
fn every_row_of_the_tables() {
    for folder in table_folders() {
        for (model, column, bsdf) in MODELS {
            let table = Table::load(folder.join(format!("public_{model}.csv")));
            let mut worst: f64 = 0.0;
            for row in table.rows() {
                let got = bsdf(&row).eval(row.direction("wo"), row.direction("wi"));
                let want = row.rgb(column);
                for (got, want) in got.to_array().into_iter().zip(want.to_array()) {
                    let error = (got - want).abs();
                    worst = worst.max((error - 1e-12).max(0.0) / want.abs().max(1e-300));
                    assert!(
                        error <= 1e-6 * want.abs() + 1e-12,
                        "{}: got {got:e}, want {want:e}",
                        row.place()
                    );
                }
            }
            println!("{}: worst relative error {worst:.1e}", table.name);
        }
    }
}

#[test]
fn reciprocity() {
    for (model, _, bsdf) in MODELS {
        let table = Table::load(table_folders()[0].join(format!("public_{model}.csv")));
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

#[test]
fn albedo_of_matte() {
    each_albedo("matte", |row| {
        let bsdf = Bsdf::Matte(Matte {
            color: DVec3::ONE,
            sigma: row.get("sigma_deg"),
        });
        vec![(albedo(&bsdf, wo(row), 1 << 14).x, row.get("orennayar_kd1"))]
    });
}

#[test]
fn albedo_of_plastic() {
    each_albedo("plastic", |row| {
        let specular = |eta| {
            let (diffuse, specular) = (DVec3::ZERO, DVec3::ONE);
            let bsdf = Plastic {
                diffuse,
                specular,
                eta,
                alpha: row.get("alpha"),
            };
            albedo(&Bsdf::Plastic(bsdf), wo(row), 1 << 15).x
        };
        let furnace = white_metal(Ggx::isotropic(row.get("alpha")));
        vec![
            (specular(1.5), row.get("spec_eta1p5")),
            (albedo(&furnace, wo(row), 1 << 15).x, row.get("spec_F1")),
        ]
    });
}

#[test]
fn albedo_of_metal() {
    each_albedo("metal", |row| {
        let bsdf = Bsdf::Metal(Metal {
            eta: DVec3::new(0.143_119, 0.374_957, 1.442_48),
            k: DVec3::new(3.983_16, 2.385_72, 1.603_22),
            ggx: Ggx {
                alpha_x: row.get("alphax"),
                alpha_y: row.get("alphay"),
            },
        });
        let wo = at_cosine(row.get("mu"), row.get("phi_o_deg"));
        let (got, want) = (albedo(&bsdf, wo, 1 << 15), row.rgb("gold"));
        (0..3).map(|i| (got[i], want[i])).collect()
    });
}

#[test]
fn albedo_of_substrate() {
    each_albedo("substrate", |row| {
        let bsdf = Bsdf::Substrate(Substrate {
            diffuse: DVec3::ONE,
            specular: DVec3::splat(row.get("rs")),
            ggx: Ggx::isotropic(row.get("alpha")),
        });
        vec![(albedo(&bsdf, wo(row), 1 << 15).x, row.get("total_rd1"))]
    });
}

#[test]
fn albedo_of_principled() {
    each_albedo("disney", |row| {
        let plain = white_principled(row.get("roughness"), row.get("cc_gloss_eq_roughness"));
        let coated = Principled {
            clearcoat: 1.0,
            sheen: 1.0,
            ..plain
        };
        let flat = Principled {
            subsurface: 1.0,
            ..plain
        };
        let metal = Principled {
            metallic: 1.0,
            ..plain
        };
        let total = |bsdf| albedo(&Bsdf::Principled(bsdf), wo(row), 1 << 15).x;
        let base = row.get("total_white_dielectric_cc0");
        vec![
            (total(plain), base),
            (total(coated), row.get("total_white_dielectric_cc1_sheen1")),
            (
                total(flat),
                base + row.get("fakess_c1") - row.get("diffuse_plus_retro"),
            ),
            (total(metal), row.get("spec_metal_white")),
        ]
    });
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
    let bsdf = Bsdf::Principled(Principled {
        clearcoat: 1.0,
        ..white_principled(0.5, 0.0)
    });
    let (n, wo) = (1 << 18, at_cosine(0.6, 30.0));
    let uniform = |i| {
        let xi = common::r2(i);
        bsdf.pdf(wo, at_cosine(xi.x, 360.0 * xi.y)) * std::f64::consts::TAU
    };
    let integral = (0..n).map(uniform).sum::<f64>() / f64::from(n);
    let above = (0..n).filter(|&i| bsdf.sample(wo, common::r2(i)).z > 0.0);
    let share = above.count() as f64 / f64::from(n);
    assert!(
        (integral - share).abs() < 1e-3,
        "{integral} against {share}"
    );
}

fn wo(row: &Row) -> DVec3 {
    at_cosine(row.get("mu"), 0.0)
}

/// F = 1 to 1e-16 by an absorption beyond any material's.
fn white_metal(ggx: Ggx) -> Bsdf {
    Bsdf::Metal(Metal {
        eta: DVec3::ONE,
        k: DVec3::splat(1e8),
        ggx,
    })
}

fn white_principled(roughness: f64, clearcoat_gloss: f64) -> Principled {
    Principled {
        base_color: DVec3::ONE,
        metallic: 0.0,
        eta: 1.5,
        roughness,
        ggx: Ggx::isotropic((roughness * roughness).max(1e-3)),
        specular_tint: 0.0,
        sheen: 0.0,
        sheen_tint: 0.0,
        clearcoat: 0.0,
        clearcoat_gloss,
        subsurface: 0.0,
    }
}

/// Two-sided: an albedo that is too low is as wrong as one that is too high.
fn each_albedo(model: &str, pairs: impl Fn(&Row) -> Vec<(f64, f64)>) {
    for folder in table_folders() {
        let path = folder.join(format!("albedo_{model}.csv"));
        if !path.is_file() {
            // AMAS_BSDF_TABLES promises the public_*.csv only.
            continue;
        }
        for row in Table::load(path).rows() {
            for (i, (got, want)) in pairs(&row).into_iter().enumerate() {
                assert!(
                    (got - want).abs() <= 1e-3,
                    "{}, figure {i}: got {got}, want {want}",
                    row.place()
                );
            }
        }
    }
}
