//! The chapter on hard cases as text.

use super::formulas::formulas;
use super::pictures::Picture;
use super::{Point, Verdict};
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(
        file,
        "formula,case,absolute,rows,naive_cpu_worst,naive_cpu_not_finite,shipped_cpu_worst,shipped_cpu_not_finite,\
         naive_device_worst,naive_device_not_finite,shipped_device_worst,shipped_device_mean,shipped_device_not_finite"
    )?;
    points.iter().try_for_each(|p| {
        let pair = |v: &Verdict| format!("{:.3e},{}", v.worst, v.not_finite);
        writeln!(
            file,
            "\"{}\",\"{}\",{},{},{},{},{},{:.3e},{:.3e},{}",
            p.formula,
            p.case,
            p.absolute,
            p.rows,
            pair(&p.naive_cpu),
            p.shipped_cpu.as_ref().map_or_else(|| ",".into(), pair),
            pair(&p.naive_device),
            p.shipped_device.worst,
            p.shipped_device.mean,
            p.shipped_device.not_finite
        )
    })
}

fn cell(verdict: &Verdict, absolute: bool) -> String {
    let infinite =
        if verdict.not_finite > 0 { format!(", {} NaN", verdict.not_finite) } else { String::new() };
    format!("{:.1e}{}{infinite}", verdict.worst, if absolute { " abs." } else { "" })
}

/// What is printed.
pub(super) fn summary(points: &[Point], pictures: &[Picture]) -> String {
    let mut text =
        format!("{:<30}{:<60}{:>22}  {:>22}\n", "hard case", "", "usual, on the device", "shipped");
    for p in points {
        let (naive, shipped) = (cell(&p.naive_device, p.absolute), cell(&p.shipped_device, p.absolute));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:<30}{:<60}{naive:>22}  {shipped:>22}", p.formula, p.case);
    }
    for p in pictures {
        let _ = writeln!(text, "{:<16}{:<74}{:>22}  {:>22}", p.what, p.case, "", of_picture(p));
    }
    text.trim_end().to_owned()
}

/// Worst error or ratio, and how many values are not finite.
fn of_picture(p: &Picture) -> String {
    let worst = p.worst.unwrap_or(p.largest[0]);
    cell(&Verdict { worst, not_finite: p.not_finite, ..Verdict::default() }, false)
}

pub(super) fn page(device: &DeviceInfo, (points, pictures): (&[Point], &[Picture]), quick: bool) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let option = if quick { " --quick" } else { "" };
    let rows = points.first().map_or(0, |p| p.rows);
    let mut text = format!(
        "# Hard cases in float32\n\n\
         Written by `amas report --chapter hard{option} --out DIR` at {commit} on {} ({}, Vulkan {}). `hard.csv` has the \
         formulas, `hard.json` every figure. Nothing here is timed.\n\n\
         Each formula as it is usually written and as it ships in `glsl/lib/`, on {rows} random inputs of each kind: worst \
         relative error against double precision, or absolute error (abs.) where the value may be 0, and how many values were \
         infinite or no numbers (NaN). *Processor* is \
         float32 in Rust, *device* a compute shader (`glsl/probe/hard.comp`, `hard_area.comp`) that includes what ships unchanged. Directions \
         are rounded to float32, and the truth is that of their unit vectors; of the two D, which need the half vector's direction \
         only, that of the rounded ones. Of form factors it is the contour above the horizon, arcs by adaptive \
         quadrature. The usual disk is by intent a sphere where that reaches below the horizon, and the usual line has no width: \
         a level cylinder of radius R and half length l, d above the point, has l d R²/(d² + l²)² more, by the nearer halves of \
         its rims, which bulge beyond the line's ends. What ships for lines has vertices on either side, sums along and across \
         the axis that are rounded together: how much of a thin line's width that leaves is what its rows say.\n\n\
         | formula | inputs | usual, processor | shipped, processor | usual, device | shipped, device |\n\
         | --- | --- | --- | --- | --- | --- |\n",
        device.name, device.driver, device.api
    );
    for p in points {
        let cell = |verdict: &Verdict| cell(verdict, p.absolute);
        let shipped_cpu = p.shipped_cpu.as_ref().map_or_else(|| "–".into(), cell);
        let _ = writeln!(
            text,
            "| {} | {} | {} | {shipped_cpu} | {} | {} |",
            p.formula,
            p.case,
            cell(&p.naive_cpu),
            cell(&p.naive_device),
            cell(&p.shipped_device)
        );
    }
    text.push_str("\nThe two forms of each:\n\n| formula | usual | shipped |\n| --- | --- | --- |\n");
    for formula in formulas() {
        let escaped = |form: &str| form.replace('|', "\\|");
        let (usual, shipped) = (escaped(formula.naive_text), escaped(formula.shipped_text));
        let _ = writeln!(text, "| {} | {usual} | {shipped} |", formula.name);
    }
    of_pictures(&mut text, pictures);
    text
}

fn of_pictures(text: &mut String, pictures: &[Picture]) {
    text.push_str(
        "\n## Whole pictures\n\n\
         *Clusters*: worst relative error of the picture with light lists against that with every light on every pixel, of \
         the same program; values below 0.1 % of the mean are judged by that. *Gathered light* of two rounds of 256 virtual \
         lights: largest value over the largest of paths in double precision, 256 a pixel, where 1 is right and fireflies are \
         many times that; where paths bring nothing, the largest value itself.\n\n\
         | what | scene | worst | largest value | of the reference |\n| --- | --- | --- | --- | --- |\n",
    );
    for p in pictures {
        let worst = match p.worst {
            Some(_) if p.what == "clusters" => of_picture(p),
            Some(ratio) => {
                format!("× {ratio:.2}{}", of_picture(p).split_once(',').map_or("", |(_, nan)| nan))
            }
            None => of_picture(p),
        };
        let [got, want] = p.largest;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {} | {} | {worst} | {got:.3e} | {want:.3e} |", p.what, p.case);
    }
}
