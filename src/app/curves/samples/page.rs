//! The chapter on samples as text.

use super::super::marks;
use super::{FAMILIES, Figures, Law, Point};
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(file, "way,samples,cpu_ms,cpu_ms_mad,wall_ms,error,bias,pareto,default")?;
    points.iter().try_for_each(|p| {
        writeln!(
            file,
            "{},{},{:.3},{:.3},{:.3},{:.6},{:.6},{},{}",
            p.family.name().replace(',', ""),
            p.samples,
            p.cpu_ms.median,
            p.cpu_ms.mad,
            p.wall_ms.median,
            p.error,
            p.bias,
            u8::from(p.pareto),
            u8::from(p.default)
        )
    })
}

/// What is printed.
pub(super) fn summary(figures: &Figures) -> String {
    let mut text = format!("{:<18} {:>7}    CPU ms     error      bias\n", "samples", "");
    for p in &figures.points {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<18} {:>7}  {:>8.2}  {:>8.5}  {:>8.5}",
            p.family.name(),
            p.samples,
            p.cpu_ms.median,
            p.error,
            p.bias
        );
    }
    figures.laws.iter().for_each(|law| text += &(sentence(law) + "\n"));
    text.trim_end().to_owned()
}

fn sentence(law: &Law) -> String {
    format!("{}: the error goes with the samples to the power {:+.2}.", law.family.name(), law.exponent)
}

pub(super) fn page(device: &DeviceInfo, figures: &Figures) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let quick = if figures.quick { " --quick" } else { "" };
    let load = figures.load.map_or_else(String::new, |load| load.sentence() + "\n\n");
    let [width, height] = figures.extent.size;
    let mut text = format!(
        "# Samples: error against time\n\n\
         Written by `amas report --chapter samples{quick} --out DIR` at {commit} on {} ({}, Vulkan {}). `samples.csv` and \
         `samples.json` have every figure.\n\n{load}\
         ![Error over CPU time](samples.png)\n\n\
         A floor of plastic in the penumbra of a sheet under a rectangle, a disk and a line, without edges in view; {width} × {height} \
         pixels. Errors are root mean squares over all values against the oracle's picture, whose pixels are means over {} \
         rays, relative to its mean; its own, {:.1} % of a pixel at most, is part of them. CPU time is that of the whole \
         process, medians of {} frames. *Paths* are the oracle's, the random baseline: for each ray a light and a direction of \
         the BSDF, weighted by the balance heuristic, in double precision.\n",
        device.name,
        device.driver,
        device.api,
        figures.extent.rays,
        100.0 * figures.extent.tolerance,
        figures.extent.rounds
    );
    for family in FAMILIES {
        let _ = write!(
            text,
            "\n## {}\n\n| samples | CPU ms | wall ms | error | bias | |\n| --- | --- | --- | --- | --- | --- |\n",
            family.name()
        );
        for p in figures.points.iter().filter(|p| p.family == family) {
            let _ = writeln!(
                text,
                "| {} | {:.2} ± {:.2} | {:.2} | {:.3} % | {:+.3} % | {} |",
                p.samples,
                p.cpu_ms.median,
                p.cpu_ms.mad,
                p.wall_ms.median,
                100.0 * p.error,
                100.0 * p.bias,
                marks(p.pareto, p.default)
            );
        }
        if let Some(law) = figures.laws.iter().find(|law| law.family == family) {
            let _ = writeln!(text, "\n{}", sentence(law));
        }
    }
    text.push_str(
        "\nThe default is one sample through each pixel's centre, because without shadows that is exact but for edges, whose \
         steps are a matter of taste; with shadows a scene asks for as many as it wants to rid penumbrae of grain.\n",
    );
    text
}
