//! Directional albedos: the figures that the tables know, and the points of a quadrature for them.

use std::f64::consts::PI;
use std::fmt;

use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use glam::{DVec2, DVec3};

use super::tables::{Row, Table};

/// A figure of the tables: ∫ f cosθi dωi of a BSDF seen from `wo`.
pub(crate) struct Figure {
    pub bsdf: Bsdf,
    pub wo: DVec3,
    pub want: DVec3,
    /// Where it is written.
    pub place: String,
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { bsdf, wo, want, place } = self;
        write!(f, "{place}: {bsdf:?}, wo {wo}, want {want}")
    }
}

/// Every figure of a model's table.
pub(crate) fn figures(model: &str, table: &Table) -> Vec<Figure> {
    let of = match model {
        "matte" => matte,
        "plastic" => plastic,
        "metal" => metal,
        "substrate" => substrate,
        "disney" => principled,
        _ => panic!("no model is called {model}"),
    };
    table.rows().flat_map(|row| of(&row)).collect()
}

fn figure(row: &Row, bsdf: Bsdf, want: DVec3) -> Figure {
    // Only the table of metals, which may be anisotropic, has an azimuth.
    let phi = row.find("phi_o_deg").unwrap_or(0.0);
    Figure { bsdf, wo: at_cosine(row.get("mu"), phi), want, place: row.place() }
}

fn grey(row: &Row, bsdf: Bsdf, column: &str) -> Figure {
    figure(row, bsdf, DVec3::splat(row.get(column)))
}

fn matte(row: &Row) -> Vec<Figure> {
    let bsdf = Bsdf::Matte(Matte { color: DVec3::ONE, sigma: row.get("sigma_deg") });
    vec![grey(row, bsdf, "orennayar_kd1")]
}

fn plastic(row: &Row) -> Vec<Figure> {
    let specular = Bsdf::Plastic(Plastic {
        diffuse: DVec3::ZERO,
        specular: DVec3::ONE,
        eta: 1.5,
        alpha: row.get("alpha"),
    });
    let furnace = white_metal(Ggx::isotropic(row.get("alpha")));
    vec![grey(row, specular, "spec_eta1p5"), grey(row, furnace, "spec_F1")]
}

fn metal(row: &Row) -> Vec<Figure> {
    let bsdf = Bsdf::Metal(Metal {
        eta: DVec3::new(0.143_119, 0.374_957, 1.442_48),
        k: DVec3::new(3.983_16, 2.385_72, 1.603_22),
        ggx: row.ggx(),
    });
    vec![figure(row, bsdf, row.rgb("gold"))]
}

fn substrate(row: &Row) -> Vec<Figure> {
    let bsdf = Bsdf::Substrate(Substrate {
        diffuse: DVec3::ONE,
        specular: DVec3::splat(row.get("rs")),
        ggx: Ggx::isotropic(row.get("alpha")),
    });
    vec![grey(row, bsdf, "total_rd1")]
}

fn principled(row: &Row) -> Vec<Figure> {
    let plain = white_principled(row.get("roughness"), row.get("cc_gloss_eq_roughness"));
    let coated = Principled { clearcoat: 1.0, sheen: 1.0, ..plain };
    let flat = Principled { subsurface: 1.0, ..plain };
    let metal = Principled { metallic: 1.0, ..plain };
    let base = row.get("total_white_dielectric_cc0");
    let flat_want = base + row.get("fakess_c1") - row.get("diffuse_plus_retro");
    let total = |bsdf, column| grey(row, Bsdf::Principled(bsdf), column);
    vec![
        total(plain, "total_white_dielectric_cc0"),
        total(coated, "total_white_dielectric_cc1_sheen1"),
        total(metal, "spec_metal_white"),
        figure(row, Bsdf::Principled(flat), DVec3::splat(flat_want)),
    ]
}

/// F = 1 to 4e-12 by an absorption beyond any material's; more would leave float32's range of squares.
pub(crate) fn white_metal(ggx: Ggx) -> Bsdf {
    Bsdf::Metal(Metal { eta: DVec3::ONE, k: DVec3::splat(1e6), ggx })
}

pub(crate) fn white_principled(roughness: f64, clearcoat_gloss: f64) -> Principled {
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

/// Point `i` of Roberts' R2 sequence.
pub(crate) fn r2(i: u32) -> DVec2 {
    let i = f64::from(i) + 0.5;
    DVec2::new(i * 0.754_877_666_246_692_7, i * 0.569_840_290_998_053_2).fract()
}

/// Directions and weights of a quadrature, ∫ f cosθi dωi ≈ Σ weight · f: `n` quasi-random points of each of two
/// strategies by the balance heuristic, namely the oracle's own sampling, and one that crowds at grazing directions,
/// where 1/(wi·h) of substrate has its spike. `place` moves each direction to one that the evaluation can represent.
pub(crate) fn quadrature(
    bsdf: &Bsdf,
    wo: DVec3,
    n: u32,
    place: impl Fn(DVec3) -> DVec3,
) -> Vec<(DVec3, f64)> {
    let point = |wi: DVec3| {
        let wi = place(wi);
        let pdf = bsdf.pdf(wo, wi) + grazing_pdf(wo, wi);
        (wi.z > 0.0).then(|| (wi, wi.z / (pdf * f64::from(n))))
    };
    (0..n).flat_map(|i| [bsdf.sample(wo, r2(i)), grazing(wo, r2(i))]).filter_map(point).collect()
}

/// Directional albedo of the oracle.
pub(crate) fn albedo(bsdf: &Bsdf, wo: DVec3, n: u32) -> DVec3 {
    let points = quadrature(bsdf, wo, n, |wi| wi);
    points.into_iter().map(|(wi, weight)| bsdf.eval(wo, wi) * weight).sum()
}

/// cosθ = x², and an azimuth that crowds opposite to `wo`.
fn grazing(wo: DVec3, xi: DVec2) -> DVec3 {
    let side = 2.0 * xi.y - 1.0;
    let azimuth = wo.y.atan2(wo.x) + PI * (1.0 - side * side) * side.signum();
    at_cosine(xi.x * xi.x, azimuth.to_degrees())
}

fn grazing_pdf(wo: DVec3, wi: DVec3) -> f64 {
    let turn = (wi.y.atan2(wi.x) - wo.y.atan2(wo.x)).rem_euclid(2.0 * PI);
    let side = (1.0 - turn.min(2.0 * PI - turn) / PI).max(0.0).sqrt();
    1.0 / (8.0 * PI * wi.z.sqrt() * side).max(1e-300)
}

/// The direction at cosine `mu` from the normal, in the xz plane turned by `phi` degrees.
pub(crate) fn at_cosine(mu: f64, phi: f64) -> DVec3 {
    let (sin, phi) = ((1.0 - mu * mu).sqrt(), phi.to_radians());
    DVec3::new(sin * phi.cos(), sin * phi.sin(), mu)
}
