//! pbrt-v3 in double precision, row by row. The rule is that of the tables' README.

use glam::DVec3;

use crate::common::gpu::CheckedGpu;
use crate::common::tables::{MODELS, Row, Table, TableModel, values};
use crate::probe::{Case, Variant, eval};

#[test]
fn tables_matte() {
    check("matte");
}

#[test]
fn tables_plastic() {
    check("plastic");
}

#[test]
fn tables_metal() {
    check("metal");
}

#[test]
fn tables_substrate() {
    check("substrate");
}

#[test]
fn tables_disney() {
    check("disney");
}

/// With everything compiled in, and trimmed to what each row needs: rows of equal alphas without anisotropy, rows with a
/// weight of zero without that lobe.
fn check(name: &str) {
    let model = MODELS.into_iter().find(|model| model.0 == name).unwrap();
    let table = values(name);
    let gpu = CheckedGpu::open();
    for (choice, choose) in Variant::CHOICES {
        let cases: Vec<_> = table.rows().map(|row| case(&model, &row)).collect();
        let got = eval(&gpu, &cases, choose);
        let worst = judge(&model, &table, &cases, &got)
            .unwrap_or_else(|failure| panic!("{name}, {choice}: {failure}"));
        println!("{name}, {choice}: {} rows, worst at {worst:.3} of the rule", cases.len());
    }
    gpu.finish();
}

fn case((_, _, bsdf): &TableModel, row: &Row) -> Case {
    Case::new(&bsdf(row), row.raw_direction("wo"), row.raw_direction("wi"))
}

/// The worst share of the rule, or the failures in words.
fn judge(model: &TableModel, table: &Table, cases: &[Case], got: &[DVec3]) -> Result<f64, String> {
    let (mut worst, mut failed): (f64, Vec<String>) = (0.0, vec![]);
    for ((row, case), &got) in table.rows().zip(cases).zip(got) {
        let want = row.rgb(model.1);
        let allowed = (5e-6 + 128.0 * row.get("cond")) * want.abs() + 1e-9;
        let share = ((got - want).abs() / allowed).to_array();
        // Not `max`, which would forget a NaN.
        if share.iter().all(|&share| share <= 1.0) {
            worst = share.into_iter().fold(worst, f64::max);
        } else {
            failed.push(failure(&row, case, got, want, share));
        }
    }
    match failed.first() {
        None => Ok(worst),
        Some(first) => Err(format!("{} of {} rows; the first:\n{first}", failed.len(), cases.len())),
    }
}

fn failure(row: &Row, case: &Case, got: DVec3, want: DVec3, share: [f64; 3]) -> String {
    let relative = (got - want) / want;
    format!(
        "{}: {case}\n  got {got:?}\n  want {want:?}\n  relative error {relative:?}, share of the rule {share:.3?}",
        row.place()
    )
}
