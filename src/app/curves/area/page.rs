//! The chapter on area lights as text.

use super::configurations::{BANDS, DISTRIBUTION, SHAPES};
use super::figures::{FLOOR, Point};
use super::tiers::{Family, TIERS};
use super::{Figures, sizes};
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv<'a>(file: &mut impl Write, mut points: impl Iterator<Item = &'a Point>) -> io::Result<()> {
    writeln!(file, "band,model,shape,share,tier,ns,ns_mad,error,error_p99,bias,count,pareto")?;
    points.try_for_each(|p| {
        let share = p.share.map_or_else(String::new, |share| share.to_string());
        let (band, model, shape, tier) = (p.band, p.model, p.shape, p.tier.replace(',', ""));
        let front = u8::from(p.pareto);
        writeln!(
            file,
            "{band},{model},{shape},{share},{tier},{:.2},{:.2},{:.6},{:.6},{:.6},{},{front}",
            p.ns, p.ns_mad, p.error, p.error_p99, p.bias, p.count
        )
    })
}

/// What is printed.
pub(super) fn summary(figures: &Figures) -> String {
    let mut text = String::new();
    for (band, _) in BANDS {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{band:<24}     ns   mean error   p99 error       bias   front");
        for p in figures.points.iter().filter(|p| p.summary() && p.band == band) {
            let front = if p.pareto { "yes" } else { "" };
            let _ = writeln!(
                text,
                "{:<24}{:>7.1}   {:>10.5}   {:>9.5}   {:>8.5}   {front}",
                p.tier, p.ns, p.error, p.error_p99, p.bias
            );
        }
    }
    text.trim_end().to_owned()
}

pub(super) fn page(device: &DeviceInfo, figures: &Figures) -> String {
    let mut text = String::new();
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let command = if figures.quick { "amas report --quick" } else { "amas report" };
    let _ = write!(
        text,
        "# Area lights: speed against error\n\n\
         Written by `{command} --out DIR` at {commit} on {} ({}, Vulkan {}). `area.csv` and `area.json` have every cell.\n\n\
         ![Mean relative error over nanoseconds per light and pixel](area.png)\n\n\
         Configurations: {DISTRIBUTION}. {}.\n\n\
         Time is that of a compute shader (`glsl/probe/area_tier.comp`) that includes `glsl/direct/` unchanged, for the \
         whole device; subtracted is what setting up a surface costs, which is paid once a pixel, and loading a light's \
         record. All 64 pixels of a workgroup have one configuration, so nothing diverges. No shadows, no textures. \
         The error of an estimate is relative to the truth, or to {} % of the cell's mean truth where that is more. \
         Means over cells, one for each model and shape.\n\n\
         *amas* is what `render` does, with `light_error` 0 and .01. *Quadrature n* has n nodes a panel of azimuth for \
         the specular lobe, 4 being what ships. Lambert's lobe is in closed form there and under *LTC closed form*. *LTC \
         samples* are random points of each lobe in its own coordinates.\n",
        device.name,
        device.driver,
        device.api,
        figures.extent,
        100.0 * FLOOR,
    );
    for (band, alphas) in BANDS {
        let alphas: Vec<_> = alphas.iter().map(f64::to_string).collect();
        let _ = write!(
            text,
            "\n## {band}: alpha {}\n\n\
             | estimator | ns per light and pixel | rectangle | ellipse | line | mean error | p99 | bias | Pareto front |\n\
             | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
            alphas.join(", ")
        );
        for p in figures.points.iter().filter(|p| p.summary() && p.band == band) {
            let shapes = SHAPES.map(|shape| match mean_ns(&figures.points, p, shape) {
                Some(ns) => format!("{ns:.0}"),
                None => "–".into(),
            });
            let front = if p.pareto { "yes" } else { "" };
            let _ = writeln!(
                text,
                "| {} | {:.0} | {} | {:.3} % | {:.2} % | {:+.3} % | {front} |",
                p.tier,
                p.ns,
                shapes.join(" | "),
                100.0 * p.error,
                100.0 * p.error_p99,
                100.0 * p.bias
            );
        }
        let _ = write!(
            text,
            "\nMean error in percent by model and shape:\n\n| estimator |{}\n| --- |{}\n",
            cells(&figures.points, band).map(|p| format!(" {} {} |", p.model, p.shape)).collect::<String>(),
            cells(&figures.points, band).map(|_| " --- |").collect::<String>(),
        );
        for tier in TIERS.iter().filter(|tier| tier.family != Family::None) {
            let own = figures.points.iter().filter(|p| !p.summary() && p.band == band && p.tier == tier.name);
            let errors: String = own.map(|p| format!(" {:.3} |", 100.0 * p.error)).collect();
            let _ = writeln!(text, "| {} |{errors}", tier.name);
        }
    }
    sizes::section(&mut text, &figures.sizes);
    text
}

/// One point of each cell of a band.
fn cells<'a>(points: &'a [Point], band: &'a str) -> impl Iterator<Item = &'a Point> {
    points.iter().filter(move |p| !p.summary() && p.band == band && p.tier == TIERS[1].name)
}

/// Over the models; `None` where the shape was not measured.
fn mean_ns(points: &[Point], of: &Point, shape: &str) -> Option<f64> {
    let own = points.iter().filter(|p| p.band == of.band && p.tier == of.tier && p.shape == shape);
    let (sum, count) = own.fold((0.0, 0), |(sum, count), p| (sum + p.ns, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}
