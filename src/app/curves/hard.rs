//! The chapter on hard cases: formulas that break in float32, as they are usually written and as they ship, on the
//! processor and on the device, against double precision; and pictures on which clusters and virtual lights break.

mod area;
mod bsdf;
mod formulas;
mod inputs;
mod page;
mod pictures;
mod worlds;

use super::super::report::Origin;
use super::{progress, save_tables};
use crate::error::Result;
use crate::gpu::{Device, DeviceInfo, Specialization};
use crate::probe;
use crate::reference::sampler::Random;
use crate::shared::{HardProbeRow, SPEC_HARD_FORMULA};
use formulas::{Formula, Slots, formulas};
use glam::{DVec4, Vec4};
use pictures::Picture;
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use worlds::WORLDS;

/// What is written.
pub(super) const FILES: [&str; 3] = ["hard.csv", "hard.json", "hard.md"];

/// Errors of what is smaller are relative to this: the least normal float32 is 1.2e-38.
const FLOOR: f64 = 1e-30;

/// Rows of a case.
const FULL: usize = 1 << 16;
const QUICK: usize = 1 << 12;

/// How wrong a formula is over the rows of a case.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Verdict {
    /// Worst error of the finite values, relative, or absolute as the case says.
    worst: f64,
    /// Worst absolute error of the same values, whatever the case says.
    worst_absolute: f64,
    /// Mean of what `worst` is the worst of.
    mean: f64,
    /// Values that are infinite or no numbers.
    not_finite: usize,
}

impl Verdict {
    fn of(values: impl Iterator<Item = f32>, truths: &[f64], absolute: bool) -> Self {
        let (mut verdict, mut sum) = (Self::default(), 0.0);
        for (value, truth) in values.map(f64::from).zip(truths) {
            if !value.is_finite() {
                verdict.not_finite += 1;
                continue;
            }
            let scale = if absolute { 1.0 } else { truth.abs().max(FLOOR) };
            let off = (value - truth).abs();
            let error = off / scale;
            verdict.worst = verdict.worst.max(error);
            verdict.worst_absolute = verdict.worst_absolute.max(off);
            sum += error;
        }
        verdict.mean = sum / (truths.len() - verdict.not_finite).max(1) as f64;
        verdict
    }
}

/// A formula in a case.
#[derive(Serialize)]
struct Point {
    formula: &'static str,
    case: &'static str,
    /// Errors are absolute; else relative to the truth.
    absolute: bool,
    naive: &'static str,
    shipped: &'static str,
    rows: usize,
    naive_cpu: Verdict,
    /// `null` where it has no twin on the processor.
    shipped_cpu: Option<Verdict>,
    naive_device: Verdict,
    shipped_device: Verdict,
}

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    origin: Origin<'a>,
    quick: bool,
    floor: f64,
    points: &'a [Point],
    pictures: &'a [Picture],
}

/// Measures and writes; what is printed.
pub(super) fn run(device: &Arc<Device>, quick: bool, out: &Path) -> Result<String> {
    let bar = progress(formulas().count() + WORLDS.len());
    let mut points = Vec::new();
    for formula in formulas() {
        bar.set_message(formula.name);
        points.extend(judge(device, formula, if quick { QUICK } else { FULL })?);
        bar.inc(1);
    }
    let pictures = pictures::judge(device, &bar)?;
    bar.finish_and_clear();
    device.require_silence()?;
    write(&FILES.map(|name| out.join(name)), device.info(), (&points, &pictures), quick)?;
    Ok(page::summary(&points, &pictures))
}

fn judge(device: &Arc<Device>, formula: &Formula, rows: usize) -> Result<Vec<Point>> {
    let cases = formula.cases.iter().enumerate().map(|(index, case)| {
        let mut random = Random::new(u64::from(formula.number) << 8 | index as u64);
        let inputs = case.rows(&mut random, rows)?;
        let specialization = Specialization::default().with(SPEC_HARD_FORMULA, formula.number);
        let probed = inputs.iter().map(|&[a, b, c, d]| HardProbeRow { a, b, c, d }).collect::<Vec<_>>();
        let values: Vec<[f32; 2]> = probe::run(device, formula.shader, &specialization, &probed)?;
        let truths: Vec<f64> =
            inputs.par_iter().map(|slots| (formula.truth)(&formula.exact(slots))).collect();
        let verdict = |values: &mut dyn Iterator<Item = f32>| Verdict::of(values, &truths, case.absolute);
        let single =
            |f: fn(&[Vec4; 4]) -> f32| verdict(&mut inputs.iter().map(|slots| f(&slots.map(Vec4::from))));
        Ok(Point {
            formula: formula.name,
            case: case.name,
            absolute: case.absolute,
            naive: formula.naive_text,
            shipped: formula.shipped_text,
            rows,
            naive_cpu: single(formula.naive),
            shipped_cpu: formula.shipped.map(single),
            naive_device: verdict(&mut values.iter().map(|pair| pair[0])),
            shipped_device: verdict(&mut values.iter().map(|pair| pair[1])),
        })
    });
    cases.collect()
}

impl Formula {
    /// The numbers that the device has; of directions, their unit vectors.
    fn exact(&self, slots: &Slots) -> [DVec4; 4] {
        let mut exact = slots.map(|slot| DVec4::from_array(slot.map(f64::from)));
        for slot in &mut exact[..self.directions] {
            *slot = slot.truncate().normalize_or_zero().extend(0.0);
        }
        exact
    }
}

/// Writes [`FILES`], each to its path.
fn write(
    paths: &[PathBuf; 3],
    device: &DeviceInfo,
    (points, pictures): (&[Point], &[Picture]),
    quick: bool,
) -> Result<()> {
    let [csv, json, markdown] = paths;
    let content = File { origin: Origin::of(device), quick, floor: FLOOR, points, pictures };
    let rows = |file: &mut _| page::csv(file, points);
    save_tables([csv, json, markdown], rows, &content, &page::page(device, (points, pictures), quick))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The usual form and the one that ships are the same function: in double precision they agree where the usual one has
    /// digits left, which at alpha = 1e-3 and 1e-8 from the horizon is half of its sixteen.
    #[test]
    fn both_forms_are_one_function() {
        for formula in formulas() {
            let mut checked = 0;
            for case in formula.cases {
                let mut random = Random::new(1);
                for slots in case.rows(&mut random, 500).unwrap() {
                    let slots = formula.exact(&slots);
                    let [naive, truth] = [(formula.exact_naive)(&slots), (formula.truth)(&slots)];
                    assert!(truth.is_finite(), "{}, {}: {slots:?}", formula.name, case.name);
                    if naive.is_finite() && truth.abs() > case.plain {
                        let error = (naive / truth - 1.0).abs();
                        assert!(error < 1e-4, "{}, {}: {naive} for {truth}", formula.name, case.name);
                        checked += 1;
                    }
                }
            }
            assert!(checked >= 100, "{}: {checked}", formula.name);
        }
    }
}
