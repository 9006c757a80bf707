//! `amas compare`: error figures between two pictures.

use super::args::CompareOptions;
use super::outputs::{Kind, kind};
use super::terminal::{complain, print};
use crate::compare::{Figures, compare_files};
use crate::error::Result;

pub(super) fn run(options: &CompareOptions) -> Result<()> {
    let display = [&options.a, &options.b].map(|path| kind(path).is_ok_and(|kind| kind == Kind::Display));
    if display[0] != display[1] {
        complain(
            "warning: one picture is scene-linear, the other a .png: its colours are decoded from sRGB, but exposure, tone \
             curve and 8 bits stay in them\n  remedy: compare two .exr or .pfm",
        );
    }
    let figures = compare_files(&options.a, &options.b, options.mask.as_deref(), options.block)?;
    if options.json {
        print(format_args!("{:#}", serde_json::json!(figures)))
    } else {
        print(table(&figures))
    }
}

fn table(f: &Figures) -> String {
    let rows = [
        ("relMSE", f.rel_mse),
        ("RMSE", f.rmse),
        ("mean bias", f.mean_bias),
        ("relative error, mean", f.mean_relative_error),
        ("… p50", f.p50),
        ("… p99", f.p99),
        ("… p99.9", f.p99_9),
        ("… max", f.max),
        ("share beyond 1 %", f.beyond_one_percent),
        ("largest value of A", f.largest_a),
        ("largest value of B", f.largest_b),
        ("FLIP", f.flip),
    ];
    let rows = rows.map(|(name, value)| format!("\n{name:<24}{value:.6e}"));
    format!(
        "{} × {}, {} compared, {} not finite{}",
        f.width,
        f.height,
        f.compared,
        f.non_finite,
        rows.concat()
    )
}
