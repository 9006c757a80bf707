//! Figures of an earlier run, and how those of this one compare.

use super::super::measure::median;
use super::super::statistics::{CONFIDENCE, MARGIN, Ratio, Verdict};
use super::super::terminal::print;
use super::figures::{Loads, Point, Samples};
use crate::error::{Error, Result};
use crate::gpu::DeviceInfo;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A file that `amas bench --json` wrote, as far as it is compared.
#[derive(Serialize)]
pub(super) struct Baseline {
    file: PathBuf,
    #[serde(flatten)]
    run: Run,
    confidence: f64,
    /// Relative difference that a verdict needs beyond doubt.
    margin: f64,
}

#[derive(Deserialize, Serialize)]
struct Run {
    version: String,
    commit: Option<String>,
    partial: bool,
    set: Vec<(String, String)>,
    load: Loads,
    #[serde(skip_serializing)]
    device: Named,
    #[serde(skip_serializing)]
    points: Vec<Old>,
}

#[derive(Deserialize)]
struct Named {
    name: String,
    driver: String,
    #[serde(rename = "type")]
    kind: String,
}

#[derive(Deserialize)]
struct Old {
    scene: String,
    size: [u32; 2],
    samples: Samples,
}

/// A point beside the baseline's.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Comparison {
    clock: Clock,
    baseline_median_ms: f64,
    median_ms: f64,
    #[serde(flatten)]
    ratio: Ratio,
}

/// Which time is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Clock {
    /// CPU time of the process: on a CPU device, and where there is no device time.
    Cpu,
    /// Device time.
    Device,
}

impl Baseline {
    /// # Errors
    /// [`Error::Input`] where the file is none of these, or of another schema.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let wrong = |cause: String, remedy: &str| Error::input(path, None, cause, remedy);
        let anew = "measure the baseline anew: amas bench --json FILE";
        let bytes = std::fs::read(path).map_err(|error| {
            wrong(
                format!("cannot read the baseline: {error}"),
                "check the path, or write it by amas bench --json FILE",
            )
        })?;
        let json: serde_json::Value = serde_json::from_slice(&bytes)
            .map_err(|error| wrong(format!("the baseline is not JSON: {error}"), anew))?;
        match &json["schema"] {
            serde_json::Value::Null => return Err(wrong("the baseline names no schema".into(), anew)),
            schema if *schema != 1 => {
                return Err(wrong(format!("the baseline has schema {schema}, this amas has 1"), anew));
            }
            _ => {}
        }
        let run = serde_json::from_value(json)
            .map_err(|error| wrong(format!("the baseline has not what amas bench writes: {error}"), anew))?;
        Ok(Self { file: path.into(), run, confidence: CONFIDENCE, margin: MARGIN })
    }

    /// # Errors
    /// [`Error::Input`] where it was measured on another device.
    pub(super) fn check_device(&self, device: &DeviceInfo) -> Result<()> {
        let old = &self.run.device;
        if old.name == device.name {
            return Ok(());
        }
        Err(Error::input(
            &self.file,
            None,
            format!("the baseline was measured on {:?}, this is {:?}", old.name, device.name),
            "choose the same device by --device, or measure the baseline on this one",
        ))
    }

    /// # Errors
    /// [`Error::Input`] where it has none of these points.
    pub(super) fn check_points(&self, points: &[(String, [u32; 2])]) -> Result<()> {
        if !points.iter().any(|(scene, size)| self.find(scene, *size, 0).is_some()) {
            let has = |old: &Old| format!("{} at {}x{}", old.scene, old.size[0], old.size[1]);
            let all: Vec<_> = self.run.points.iter().map(has).collect();
            return Err(Error::input(
                &self.file,
                None,
                format!("the baseline has none of these points; it has: {}", all.join(", ")),
                "measure the same scenes or suites at the same size",
            ));
        }
        Ok(())
    }

    /// The `nth` of its points with this scene at this size.
    fn find(&self, scene: &str, size: [u32; 2], nth: usize) -> Option<&Old> {
        self.run.points.iter().filter(|old| old.scene == scene && old.size == size).nth(nth)
    }

    /// Compares every point that the baseline has, too.
    pub(super) fn compare(&self, points: &mut [Point]) {
        for index in 0..points.len() {
            let (before, rest) = points.split_at_mut(index);
            let point = &mut rest[0];
            let same = |other: &&Point| other.scene == point.scene && other.size == point.size;
            let nth = before.iter().filter(same).count();
            let old = self.find(&point.scene, point.size, nth);
            point.comparison = old.and_then(|old| self.comparison(&point.samples, &old.samples));
        }
    }

    fn comparison(&self, new: &Samples, old: &Samples) -> Option<Comparison> {
        let timed = !new.gpu_ms.is_empty() && !old.gpu_ms.is_empty();
        let (clock, new, old) = if self.run.device.kind != "cpu" && timed {
            (Clock::Device, &new.gpu_ms, &old.gpu_ms)
        } else {
            (Clock::Cpu, &new.cpu_ms, &old.cpu_ms)
        };
        let [median_ms, baseline_median_ms] = [new, old].map(|times| median(times));
        let (median_ms, baseline_median_ms) = (median_ms?, baseline_median_ms?);
        Some(Comparison { clock, baseline_median_ms, median_ms, ratio: Ratio::of(new, old)? })
    }

    /// Prints where it comes from, and how this run differs from it.
    pub(super) fn introduce(&self, device: &DeviceInfo, set: &[(String, String)]) -> Result<()> {
        let run = &self.run;
        let commit = run.commit.as_deref().map_or_else(String::new, |commit| format!(", commit {commit}"));
        let partial = if run.partial { ", interrupted" } else { "" };
        let busy = if run.load.any_busy() { ", on a busy machine" } else { "" };
        let file = self.file.display();
        print(format_args!("against {file} (amas {}{commit}{partial}{busy})", run.version))?;
        if run.device.driver != device.driver {
            print(format_args!("its driver was {}, this is {}", run.device.driver, device.driver))?;
        }
        if run.set != set {
            print(format_args!("--set was {}, is {}", pairs(&run.set), pairs(set)))?;
        }
        Ok(())
    }
}

fn pairs(set: &[(String, String)]) -> String {
    match set {
        [] => "nothing".into(),
        set => set.iter().map(|(key, value)| format!("{key}={value}")).collect::<Vec<_>>().join(", "),
    }
}

/// Prints the comparisons as a table.
pub(super) fn print_comparisons(points: &[Point]) -> Result<()> {
    print(format_args!(
        "{:<24} {:<6} {:>10} {:>10} {:>7}  {:<15}  verdict",
        "point", "time", "before, ms", "now, ms", "ratio", "95 % interval"
    ))?;
    points.iter().try_for_each(|point| match &point.comparison {
        Some(comparison) => print(format_args!("{:<24} {comparison}", point.scene)),
        None => print(format_args!("{:<24} not in the baseline", point.scene)),
    })?;
    let count = |verdict| {
        let verdicts = points.iter().filter_map(|point| point.comparison.as_ref());
        verdicts.filter(|comparison| comparison.ratio.verdict == verdict).count()
    };
    let [faster, slower, undecided] = [Verdict::Faster, Verdict::Slower, Verdict::Undecided].map(count);
    print(format_args!("{faster} faster, {slower} slower, {undecided} undecided"))
}

impl std::fmt::Display for Comparison {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Ratio { ratio, low, high, verdict } = self.ratio;
        let clock = match self.clock {
            Clock::Cpu => "CPU",
            Clock::Device => "device",
        };
        write!(
            f,
            "{clock:<6} {:>10.2} {:>10.2} {ratio:>7.3}  {:<15}  {verdict}",
            self.baseline_median_ms,
            self.median_ms,
            format!("{low:.3} … {high:.3}")
        )
    }
}
