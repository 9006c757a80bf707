//! The chapter on scaling as text.

use super::peers::{CAVEATS, Frame, PEERS};
use super::sweeps::{LIGHTS, PIXELS, SWEEPS};
use super::{FITTED, Figures, Growth, Point};
use crate::app::measure::Figure;
use crate::gpu::DeviceInfo;
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(file, "sweep,count,width,height,cpu_ms,cpu_ms_mad,wall_ms,device_ms,pairs_per_pixel")?;
    points.iter().try_for_each(|p| {
        writeln!(
            file,
            "{},{},{},{},{:.3},{:.3},{:.3},{},{:.2}",
            p.sweep,
            p.count,
            p.size[0],
            p.size[1],
            p.cpu_ms.median,
            p.cpu_ms.mad,
            p.wall_ms.median,
            p.device_ms.map_or_else(String::new, |ms| format!("{:.3}", ms.median)),
            p.pairs_per_pixel
        )
    })
}

/// What is printed.
pub(super) fn summary(figures: &Figures) -> String {
    let mut text = format!("{:<14}{:>10}  {:>10}    CPU ms   wall ms\n", "scaling", "", "pixels");
    for p in &figures.points {
        let [width, height] = p.size;
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<14}{:>10}  {:>10}  {:>8.2}  {:>8.2}",
            p.sweep,
            p.count,
            format!("{width}x{height}"),
            p.cpu_ms.median,
            p.wall_ms.median
        );
    }
    figures.growth.iter().for_each(|growth| text += &(sentence(growth) + "\n"));
    text.trim_end().to_owned()
}

fn sentence(growth: &Growth) -> String {
    let each = match growth.ns_each {
        ns if ns.abs() < 1e3 => format!("{ns:.0} ns"),
        ns if ns.abs() < 1e6 => format!("{:.1} µs", 1e-3 * ns),
        ns => format!("{:.2} ms", 1e-6 * ns),
    };
    format!(
        "Over {}, time grows with the power {:.2} of the count at the end, where one more takes {each}.",
        growth.sweep, growth.slope
    )
}

pub(super) fn page(device: &DeviceInfo, figures: &Figures) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let quick = if figures.quick { " --quick" } else { "" };
    let load = figures.load.map_or_else(String::new, |load| load.sentence() + "\n\n");
    let mut text = format!(
        "# How frame time grows\n\n\
         Written by `amas report --chapter scaling{quick} --out DIR` at {commit} on {} ({}, Vulkan {}). `scaling.csv` and \
         `scaling.json` have every figure.\n\n{load}\
         ![Frame time over triangles, pixels, area lights and point lights](scaling.png)\n\n\
         Times are medians of {} frames after warm-up, all counts of a sweep in turn; CPU time is that of the whole process. \
         The slope is that of the straight line through the logarithms of CPU time (of device time where the device is no \
         CPU) of the last {FITTED} points: 1 is proportional, 0 constant. How time grows with the number of lights while as many of them reach a pixel, \
         to 2²⁰ of them, is in [lights](../lights/lights.md).\n",
        device.name, device.driver, device.api, figures.rounds
    );
    for sweep in SWEEPS {
        let _ = write!(
            text,
            "\n## By {0}\n\nScene: {1}.\n\n\
             | {0} | picture | CPU ms | wall ms | device ms | pairs a pixel |\n| --- | --- | --- | --- | --- | --- |\n",
            sweep.name, sweep.what
        );
        for p in figures.points.iter().filter(|p| p.sweep == sweep.name) {
            let [width, height] = p.size;
            let device = p.device_ms.as_ref().map_or_else(|| "–".into(), spread);
            let _ = writeln!(
                text,
                "| {} | {width} × {height} | {} | {:.1} | {device} | {:.2} |",
                p.count,
                spread(&p.cpu_ms),
                p.wall_ms.median,
                p.pairs_per_pixel
            );
        }
        if let Some(growth) = figures.growth.iter().find(|growth| growth.sweep == sweep.name) {
            let _ = writeln!(text, "\n{}", sentence(growth));
        }
    }
    peers(&mut text, figures);
    text
}

fn spread(figure: &Figure) -> String {
    format!("{:.2} ± {:.2}", figure.median, figure.mad)
}

/// Others' frames of the same scene beside those measured here.
fn peers(text: &mut String, figures: &Figures) {
    text.push_str(
        "\n## Beside other programs\n\nThe same scene, wall ms / CPU ms of a frame of 640 × 360 pixels, and in the last column \
         of 1280 × 720.\n\n| lights |",
    );
    let lights = figures.points.iter().filter(|p| p.sweep == LIGHTS && p.size == [640, 360]);
    let large = figures.points.iter().find(|p| p.sweep == PIXELS && p.size == [1280, 720]);
    let own: Vec<Frame> = lights.map(frame).collect();
    let counts = own.iter().chain(PEERS.iter().flat_map(|peer| peer.frames)).map(|frame| frame.lights);
    let mut counts: Vec<u64> = counts.collect();
    counts.sort_unstable();
    counts.dedup();
    counts.iter().for_each(|count| *text += &format!(" {count} |"));
    *text += " 4096, large |\n| --- |";
    *text += &" --- |".repeat(counts.len() + 1);
    let mut row = |name: &str, frames: &[Frame], large: Option<Frame>| {
        *text += &format!("\n| {name} |");
        for count in &counts {
            *text += &cell(frames.iter().find(|frame| frame.lights == *count).copied());
        }
        *text += &cell(large);
    };
    row("amas, as measured above", &own, large.map(frame));
    for peer in &PEERS {
        row(&format!("{}, {}", peer.name, peer.driver), peer.frames, peer.large);
    }
    *text += "\n\n";
    *text += CAVEATS;
}

fn frame(p: &Point) -> Frame {
    Frame { lights: p.count, wall_ms: p.wall_ms.median, cpu_ms: Some(p.cpu_ms.median) }
}

fn cell(frame: Option<Frame>) -> String {
    match frame {
        Some(Frame { wall_ms, cpu_ms: Some(cpu_ms), .. }) => format!(" {wall_ms:.0} / {cpu_ms:.0} |"),
        Some(Frame { wall_ms, .. }) => format!(" {wall_ms:.0} / – |"),
        None => " – |".into(),
    }
}
