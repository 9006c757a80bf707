//! The chapter on gathered light as text.

use super::super::marks;
use super::Figures;
use super::figures::{Family, Point, paths_after};
use super::plain::CLAMP;
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(file, "way,count,rounds,cpu_s,cpu_s_mad,wall_s,error,bias,estimate,pareto,default")?;
    points.iter().try_for_each(|p| {
        writeln!(
            file,
            "{},{},{},{:.5},{:.5},{:.5},{:.6},{:.6},{},{},{}",
            p.family.name().replace(',', ""),
            p.count,
            p.rounds,
            p.cpu_s.median,
            p.cpu_s.mad,
            p.wall_s.median,
            p.error,
            p.bias,
            p.estimate.map_or_else(String::new, |estimate| format!("{estimate:.6}")),
            u8::from(p.pareto),
            u8::from(p.default)
        )
    })
}

/// What is printed.
pub(super) fn summary(figures: &Figures) -> String {
    let mut text = format!(
        "{:<22} {:>6} {:>6}    CPU s    error     bias  estimate  front\n",
        "gathered light", "count", "rounds"
    );
    for p in &figures.points {
        let estimate = p.estimate.map_or_else(String::new, |estimate| format!("{estimate:.4}"));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<22} {:>6} {:>6} {:>8.3} {:>8.4} {:>8.4}  {estimate:>8}  {}",
            p.family.name(),
            p.count,
            p.rounds,
            p.cpu_s.median,
            p.error,
            p.bias,
            marks(p.pareto, p.default)
        );
    }
    text.trim_end().to_owned()
}

pub(super) fn page(device: &DeviceInfo, figures: &Figures) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let quick = if figures.quick { " --quick" } else { "" };
    let load = figures.load.map_or_else(String::new, |load| load.sentence() + "\n\n");
    let mut text = format!(
        "# Gathered light: error against seconds\n\n\
         Written by `amas report --chapter indirect{quick} --out DIR` at {commit} on {} ({}, Vulkan {}). `indirect.csv` and \
         `indirect.json` have every figure.\n\n{load}\
         ![Error over CPU seconds](indirect.png)\n\n\
         The scene is `scenes/indirect.toml`, a box with a glossy floor and a ball of gold under one panel; {}. Judged is the \
         light that comes by way of other surfaces, without the panel's own, against paths in double precision. Errors are \
         root mean squares over all values, relative to the mean of the whole picture, direct light too, as `error_estimate` \
         has them; the truth's own, {:.2} %, is subtracted in squares. Seconds are CPU time of the process on the same \
         processors, tracing included; what is done once for a scene (pipelines, trees over triangles for the device) is not.\n\n\
         *amas* is what `render` does, by virtual lights of a round and rounds. *Paths* are the oracle's: one light and one \
         direction of the BSDF at each vertex, weighted by the balance heuristic, in double precision, one ray at a time, \
         where the device has float32 and eight lanes. *Plain VPLs* are all virtual lights of one round at every pixel, by \
         the oracle's rays, without a tree and without paths for what is near; *clamped* where the geometry term is at most \
         {CLAMP} m⁻², which is biased. Both know only the Lambertian share of what surfaces reflect.\n",
        device.name,
        device.driver,
        device.api,
        figures.extent,
        100.0 * figures.truth_error,
    );
    gathered(&mut text, &figures.points);
    others(&mut text, &figures.points);
    text
}

/// The table of what ships; *paths* have as many seconds.
fn gathered(text: &mut String, points: &[Point]) {
    text.push_str(
        "\n## amas\n\n\
         | virtual lights a round | rounds | CPU s | wall s | error | estimated | estimated / true | bias | paths as long | front |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for p in points.iter().filter(|p| p.family == Family::Gathered) {
        let [estimate, ratio] = match p.estimate {
            Some(estimate) => [format!("{:.2} %", 100.0 * estimate), format!("{:.2}", estimate / p.error)],
            None => ["–".into(), "–".into()],
        };
        let paths = paths_after(points, p.cpu_s.median).unwrap_or(0.0);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {:.2} ± {:.2} | {:.2} | {:.2} % | {estimate} | {ratio} | {:+.2} % | {:.2} % | {} |",
            p.count,
            p.rounds,
            p.cpu_s.median,
            p.cpu_s.mad,
            p.wall_s.median,
            100.0 * p.error,
            100.0 * p.bias,
            100.0 * paths,
            marks(p.pareto, p.default)
        );
    }
    text.push_str(
        "\n*Default* is where `amas render` stops: the scene's own virtual lights, until the estimated error is below 2 %.\n",
    );
}

fn others(text: &mut String, points: &[Point]) {
    text.push_str(
        "\n## Beside it\n\n\
         | way | paths a pixel, or lights | CPU s | wall s | error | bias | front |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for p in points.iter().filter(|p| p.family != Family::Gathered) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {:.3} ± {:.3} | {:.3} | {:.2} % | {:+.2} % | {} |",
            p.family.name(),
            p.count,
            p.cpu_s.median,
            p.cpu_s.mad,
            p.wall_s.median,
            100.0 * p.error,
            100.0 * p.bias,
            marks(p.pareto, p.default)
        );
    }
}
