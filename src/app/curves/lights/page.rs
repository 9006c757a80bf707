//! The chapter on point lights as text.

use super::super::marks;
use super::sweeps::{GROWTH, SWEEPS};
use super::{Figures, Point, growth};
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(
        file,
        "sweep,setting,lights,cpu_ms,cpu_ms_mad,wall_ms,tree_cpu_ms,pairs_per_pixel,pair_ratio,error,error_p99,bias,pareto,default,nodes_visited"
    )?;
    points.iter().try_for_each(|p| {
        writeln!(
            file,
            "{},{},{},{:.2},{:.2},{:.2},{:.2},{:.2},{:.3},{:.6},{:.6},{:.6},{},{},{}",
            p.sweep,
            p.label,
            p.lights,
            p.cpu_ms.median,
            p.cpu_ms.mad,
            p.wall_ms.median,
            p.tree_ms.median,
            p.pairs_per_pixel,
            p.pair_ratio,
            p.error,
            p.error_p99,
            p.bias,
            u8::from(p.pareto),
            u8::from(p.default),
            p.nodes_visited
        )
    })
}

/// What is printed.
pub(super) fn summary(figures: &Figures) -> String {
    let mut text = String::new();
    for sweep in SWEEPS {
        // Writing to a string cannot fail.
        let _ =
            writeln!(text, "{:<24}  CPU ms   pairs/pixel   mean error   p99 error       bias", sweep.name);
        for p in figures.points.iter().filter(|p| p.sweep == sweep.name) {
            let _ = writeln!(
                text,
                "{:<24}{:>8.1}  {:>12.1}   {:>10.6}   {:>9.6}   {:>8.5}",
                p.label, p.cpu_ms.median, p.pairs_per_pixel, p.error, p.error_p99, p.bias
            );
        }
    }
    if let Some(sentence) = growth_sentence(figures) {
        text += &sentence;
    }
    text += &figures.orders.sentence();
    text.trim_end().to_owned()
}

/// What the sweep of the number of lights is for.
fn growth_sentence(figures: &Figures) -> Option<String> {
    let mut points = figures.points.iter().filter(|p| p.sweep == GROWTH);
    let (least, most) = (points.next()?, points.next_back()?);
    Some(format!(
        "From {} to {} lights, with {:.1} and {:.1} of them at a pixel, a frame takes {:.2} times as long; order and tree of \
         the most take {:.1} CPU ms, once where the lights stand.\n",
        least.lights,
        most.lights,
        least.pairs_per_pixel / least.pair_ratio,
        most.pairs_per_pixel / most.pair_ratio,
        growth(&figures.points)?,
        most.tree_ms.median
    ))
}

pub(super) fn page(device: &DeviceInfo, figures: &Figures) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let quick = if figures.quick { " --quick" } else { "" };
    let load = figures.load.map_or_else(String::new, |load| load.sentence() + "\n\n");
    let mut text = format!(
        "# Many point lights: speed against error\n\n\
         Written by `amas report --chapter lights{quick} --out DIR` at {commit} on {} ({}, Vulkan {}). `lights.csv` and \
         `lights.json` have every figure.\n\n{load}\
         ![Error over CPU time for each knob, and time over the number of lights](lights.png)\n\n\
         The scene is `scenes/million.toml`, a hall with sixty spheres of five BSDFs, with as many of its lights as each \
         table says; {}. Times are medians of whole frames, CPU time of the process; errors are relative to the picture \
         with every light on every pixel, of the same program. *At random*: one draw of lights by their \
         intensity, the same for all pixels, in the place of all.\n",
        device.name, device.driver, device.api, figures.extent
    );
    for sweep in SWEEPS {
        let _ = write!(
            text,
            "\n## `{}`\n\nSwept: {}. {}\n\n\
             | {} | lights | CPU ms | wall ms | tree, CPU ms | nodes tested | pairs a pixel | evaluated per useful | mean error | p99 | bias | |\n\
             | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
            sweep.name, sweep.what, sweep.why, sweep.name
        );
        for p in figures.points.iter().filter(|p| p.sweep == sweep.name) {
            let _ = writeln!(
                text,
                "| {} | {} | {:.1} ± {:.1} | {:.1} | {:.1} | {} | {:.1} | {:.2} | {:.4} % | {:.3} % | {:+.4} % | {} |",
                p.label,
                p.lights,
                p.cpu_ms.median,
                p.cpu_ms.mad,
                p.wall_ms.median,
                p.tree_ms.median,
                p.nodes_visited,
                p.pairs_per_pixel,
                p.pair_ratio,
                100.0 * p.error,
                100.0 * p.error_p99,
                100.0 * p.bias,
                marks(p.pareto, p.default)
            );
        }
    }
    if let Some(sentence) = growth_sentence(figures) {
        let _ = write!(text, "\n{sentence}");
    }
    let _ = write!(text, "\n{}", figures.orders.sentence());
    text
}
