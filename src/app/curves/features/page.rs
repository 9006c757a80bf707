//! The chapter on the cost of features as text.

use super::{Figures, Point};
use crate::app::statistics::{CONFIDENCE, MARGIN, Ratio};
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(file, "feature,base_ms,base_mad,unused,unused_low,unused_high,used,used_low,used_high")?;
    points.iter().try_for_each(|p| {
        let ratio = |ratio: &Option<Ratio>| {
            ratio
                .as_ref()
                .map_or_else(|| ",,".into(), |r| format!("{:.4},{:.4},{:.4}", r.ratio, r.low, r.high))
        };
        writeln!(
            file,
            "{},{:.3},{:.3},{},{}",
            p.feature,
            p.base_ms.median,
            p.base_ms.mad,
            ratio(&p.unused_ratio),
            ratio(&p.used_ratio)
        )
    })
}

fn cell(ratio: &Option<Ratio>) -> String {
    ratio.as_ref().map_or_else(
        || "–".into(),
        |r| format!("{:.3} ({:.3} … {:.3}), {}", r.ratio, r.low, r.high, r.verdict),
    )
}

/// What is printed.
pub(super) fn summary(points: &[Point]) -> String {
    let mut text = format!("{:<36}{:>8}  {:<38}{}\n", "feature", "ms", "there but not used", "used");
    for p in points {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<36}{:>8.2}  {:<38}{}",
            p.feature,
            p.base_ms.median,
            cell(&p.unused_ratio),
            cell(&p.used_ratio)
        );
    }
    text.trim_end().to_owned()
}

pub(super) fn page(device: &DeviceInfo, figures: &Figures) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let quick = if figures.quick { " --quick" } else { "" };
    let load = figures.load.map_or_else(String::new, |load| load.sentence() + "\n\n");
    let [width, height] = figures.extent.size;
    let mut text = format!(
        "# What features cost\n\n\
         Written by `amas report --chapter features{quick} --out DIR` at {commit} on {} ({}, Vulkan {}). `features.csv` and \
         `features.json` have the same figures.\n\n{load}\
         The scene is a floor and two balls under 256 point lights, {width} × {height} pixels. Each feature is measured in \
         three frames that take turns for {} rounds: without it, there but not used, and used. Ratios are of medians of CPU \
         time (device time where the device is none), with the bootstrap interval of {} % confidence; faster and slower are \
         those whose interval lies more than {} % off. What ships compiles no feature into a scene's pipelines that it does \
         not use, so that *there but not used* is the same as compiled out, and its ratio ought to be 1. Indirect light that is \
         asked for but not yet gathered, and an area light that reaches nothing, are in the pipelines: theirs is what that \
         costs. The first row is the same scene twice: what the method itself makes of nothing.\n\n\
         | feature | ms without | there but not used | ratio | used | ratio |\n\
         | --- | --- | --- | --- | --- | --- |\n",
        device.name,
        device.driver,
        device.api,
        figures.extent.rounds,
        100.0 * CONFIDENCE,
        100.0 * MARGIN
    );
    for p in &figures.points {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {:.2} ± {:.2} | {} | {} | {} | {} |",
            p.feature,
            p.base_ms.median,
            p.base_ms.mad,
            p.unused.unwrap_or("–"),
            cell(&p.unused_ratio),
            p.used.unwrap_or("–"),
            cell(&p.used_ratio)
        );
    }
    text.push_str(if device.pipeline_statistics {
        "\nThis driver has `VK_KHR_pipeline_executable_properties`, which may tell the instructions and registers of pipelines; \
         they are not read here.\n"
    } else {
        "\nHow many instructions or registers a pipeline takes, this driver does not tell: it is without \
         `VK_KHR_pipeline_executable_properties`.\n"
    });
    text
}
