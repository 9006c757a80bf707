//! Reads the BSDF tables: those of `AMAS_BSDF_TABLES`, else of `../shared/oracle` where it exists, else the subset in
//! `tests/vectors` that travels with the project.

use std::path::{Path, PathBuf};

use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use glam::DVec3;

/// The folder that `AMAS_BSDF_TABLES` names.
fn named_folder() -> Option<PathBuf> {
    std::env::var_os("AMAS_BSDF_TABLES").map(PathBuf::from)
}

/// The complete tables, or the subset.
fn own_folder() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let complete = root.join("../shared/oracle");
    if complete.is_dir() { complete } else { root.join("tests/vectors") }
}

/// Every row of a model's values. A file that is missing or empty fails the test.
pub(crate) fn values(model: &str) -> Table {
    let folder = named_folder().unwrap_or_else(own_folder);
    Table::load(folder.join(format!("public_{model}.csv")))
}

/// Every row of a model's albedos; of this project's own where the named folder, which owes values only, has none.
pub(crate) fn albedos(model: &str) -> Table {
    let file = format!("albedo_{model}.csv");
    let named = named_folder().map(|folder| folder.join(&file));
    let path = named.filter(|path| path.is_file());
    Table::load(path.unwrap_or_else(|| own_folder().join(file)))
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
            .unwrap_or_else(|| panic!("{path:?}: empty"))
            .split(',')
            .map(|name| name.trim().to_owned())
            .collect();
        let rows = lines.filter(|line| !line.trim().is_empty());
        let rows: Vec<Vec<f64>> = rows.map(numbers).collect();
        assert!(!rows.is_empty(), "{path:?}: no rows");
        assert!(
            rows.iter().all(|row| row.len() == header.len()),
            "{path:?}: a row is not as long as the header"
        );
        Self { name: path.display().to_string(), header, rows }
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.rows.len()).map(|index| Row { table: self, index })
    }
}

fn numbers(line: &str) -> Vec<f64> {
    let number = |x: &str| x.trim().parse().unwrap_or_else(|e| panic!("{x:?}: {e}"));
    line.split(',').map(number).collect()
}

impl Row<'_> {
    pub(crate) fn get(&self, column: &str) -> f64 {
        self.find(column).unwrap_or_else(|| panic!("{}: no column {column}", self.table.name))
    }

    pub(crate) fn find(&self, column: &str) -> Option<f64> {
        let found = self.table.header.iter().position(|name| name == column)?;
        Some(self.table.rows[self.index][found])
    }

    pub(crate) fn xyz(&self, prefix: &str, suffixes: [&str; 3]) -> DVec3 {
        DVec3::from_array(suffixes.map(|suffix| self.get(&format!("{prefix}_{suffix}"))))
    }

    pub(crate) fn rgb(&self, prefix: &str) -> DVec3 {
        self.xyz(prefix, ["r", "g", "b"])
    }

    /// As a float32 renderer takes it: unit only to 6e-8.
    pub(crate) fn raw_direction(&self, prefix: &str) -> DVec3 {
        self.xyz(prefix, ["x", "y", "z"])
    }

    pub(crate) fn direction(&self, prefix: &str) -> DVec3 {
        self.raw_direction(prefix).normalize()
    }

    /// Where to find the row again.
    pub(crate) fn place(&self) -> String {
        format!("{}:{}", self.table.name, self.index + 2)
    }

    pub(crate) fn ggx(&self) -> Ggx {
        Ggx { alpha_x: self.get("alphax"), alpha_y: self.get("alphay") }
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
    Bsdf::Matte(Matte { color: row.rgb("kd"), sigma: row.get("sigma_deg") })
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
    Bsdf::Metal(Metal { eta: row.rgb("eta"), k: row.rgb("k"), ggx: row.ggx() })
}

fn substrate(row: &Row) -> Bsdf {
    Bsdf::Substrate(Substrate { diffuse: row.rgb("kd"), specular: row.rgb("ks"), ggx: row.ggx() })
}

fn principled(row: &Row) -> Bsdf {
    let (roughness, aspect) = (row.get("roughness"), (1.0 - 0.9 * row.get("anisotropic")).sqrt());
    let alpha = roughness * roughness;
    Bsdf::Principled(Principled {
        base_color: row.rgb("color"),
        metallic: row.get("metallic"),
        eta: row.get("eta"),
        roughness,
        ggx: Ggx { alpha_x: (alpha / aspect).max(1e-3), alpha_y: (alpha * aspect).max(1e-3) },
        specular_tint: row.get("spectint"),
        sheen: row.get("sheen"),
        sheen_tint: row.get("sheentint"),
        clearcoat: row.get("clearcoat"),
        clearcoat_gloss: row.get("ccgloss"),
        subsurface: row.get("ss"),
    })
}
