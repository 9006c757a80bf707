//! What several tests share: the BSDF tables of `tests/vectors` and of the folders that extend them, and a scene.
#![allow(dead_code, reason = "every test binary uses its own part")]

pub(crate) mod square;

use std::f64::consts::PI;
use std::path::PathBuf;

use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use glam::{DVec2, DVec3};

/// Folders of tables: the subset that travels with the project, then the complete ones where they are.
pub(crate) fn table_folders() -> Vec<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let named = std::env::var_os("AMAS_BSDF_TABLES").map(PathBuf::from);
    let complete = named.or_else(|| Some(root.join("../shared/oracle")).filter(|p| p.is_dir()));
    std::iter::once(root.join("tests/vectors"))
        .chain(complete)
        .collect()
}

/// A CSV of numbers under a header.
pub(crate) struct Table {
    pub name: String,
    header: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// One row; panics name the column that is missing.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    table: &'a Table,
    index: usize,
}

impl Table {
    pub(crate) fn load(path: PathBuf) -> Self {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        let mut lines = text.lines();
        let header: Vec<_> = lines
            .next()
            .unwrap()
            .split(',')
            .map(str::to_owned)
            .collect();
        let rows = lines.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect());
        Self {
            name: path.display().to_string(),
            header,
            rows: rows.collect(),
        }
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.rows.len()).map(|index| Row { table: self, index })
    }
}

impl Row<'_> {
    pub(crate) fn get(&self, column: &str) -> f64 {
        let found = self.table.header.iter().position(|name| name == column);
        let column = found.unwrap_or_else(|| panic!("{}: no column {column}", self.table.name));
        self.table.rows[self.index][column]
    }

    pub(crate) fn xyz(&self, prefix: &str, suffixes: [&str; 3]) -> DVec3 {
        DVec3::from_array(suffixes.map(|suffix| self.get(&format!("{prefix}_{suffix}"))))
    }

    pub(crate) fn rgb(&self, prefix: &str) -> DVec3 {
        self.xyz(prefix, ["r", "g", "b"])
    }

    pub(crate) fn direction(&self, prefix: &str) -> DVec3 {
        self.xyz(prefix, ["x", "y", "z"]).normalize()
    }

    /// Where to find the row again.
    pub(crate) fn place(&self) -> String {
        format!("{}:{}", self.table.name, self.index + 2)
    }

    fn ggx(&self) -> Ggx {
        Ggx {
            alpha_x: self.get("alphax"),
            alpha_y: self.get("alphay"),
        }
    }
}

/// The name of a table, the column to match, and how a row becomes a BSDF.
pub(crate) type TableModel = (&'static str, &'static str, fn(&Row) -> Bsdf);

/// All five.
pub(crate) const MODELS: [TableModel; 5] = [
    ("matte", "f", matte),
    ("plastic", "f", plastic),
    ("metal", "f", metal),
    ("substrate", "f", substrate),
    ("disney", "f_2012", principled),
];

fn matte(row: &Row) -> Bsdf {
    Bsdf::Matte(Matte {
        color: row.rgb("kd"),
        sigma: row.get("sigma_deg"),
    })
}

fn plastic(row: &Row) -> Bsdf {
    Bsdf::Plastic(Plastic {
        diffuse: row.rgb("kd"),
        specular: row.rgb("ks"),
        eta: row.get("eta"),
        alpha: row.get("alpha"),
    })
}

fn metal(row: &Row) -> Bsdf {
    Bsdf::Metal(Metal {
        eta: row.rgb("eta"),
        k: row.rgb("k"),
        ggx: row.ggx(),
    })
}

fn substrate(row: &Row) -> Bsdf {
    Bsdf::Substrate(Substrate {
        diffuse: row.rgb("kd"),
        specular: row.rgb("ks"),
        ggx: row.ggx(),
    })
}

fn principled(row: &Row) -> Bsdf {
    let (roughness, aspect) = (
        row.get("roughness"),
        (1.0 - 0.9 * row.get("anisotropic")).sqrt(),
    );
    let alpha = roughness * roughness;
    Bsdf::Principled(Principled {
        base_color: row.rgb("color"),
        metallic: row.get("metallic"),
        eta: row.get("eta"),
        roughness,
        ggx: Ggx {
            alpha_x: (alpha / aspect).max(1e-3),
            alpha_y: (alpha * aspect).max(1e-3),
        },
        specular_tint: row.get("spectint"),
        sheen: row.get("sheen"),
        sheen_tint: row.get("sheentint"),
        clearcoat: row.get("clearcoat"),
        clearcoat_gloss: row.get("ccgloss"),
        subsurface: row.get("ss"),
    })
}

/// Point `i` of Roberts' R2 sequence.
pub(crate) fn r2(i: u32) -> DVec2 {
    let i = f64::from(i) + 0.5;
    DVec2::new(i * 0.754_877_666_246_692_7, i * 0.569_840_290_998_053_2).fract()
}

/// Directional albedo ∫ f cosθi dωi over `n` quasi-random points of each of two strategies, by the balance heuristic:
/// the oracle's own sampling, and one that crowds at grazing directions, where 1/(wi·h) of substrate has its spike.
pub(crate) fn albedo(bsdf: &Bsdf, wo: DVec3, n: u32) -> DVec3 {
    let term = |wi: DVec3| {
        let pdf = bsdf.pdf(wo, wi) + grazing_pdf(wo, wi);
        if wi.z > 0.0 {
            bsdf.eval(wo, wi) * wi.z / pdf
        } else {
            DVec3::ZERO
        }
    };
    let both = |i| term(bsdf.sample(wo, r2(i))) + term(grazing(wo, r2(i)));
    (0..n).map(both).sum::<DVec3>() / f64::from(n)
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
