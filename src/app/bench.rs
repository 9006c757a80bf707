//! `amas bench`: what frames and starts cost, point after point in rounds, and whether that is more than it was.

mod baseline;
mod figures;
mod subject;
mod suites;

use super::args::{BenchOptions, SceneOptions};
use super::interrupt::Interrupt;
use super::load::Since;
use super::measure::{MEGABYTE, peak_host_memory};
use super::outputs::{check_distinct, check_folder, same_file};
use super::report::{self, Origin};
use super::terminal::print;
use crate::error::{Error, Result};
use baseline::{Baseline, print_comparisons};
use figures::{Figures, Loads, Point};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use subject::{Source, Subject};

/// In every so many-th round frames are submitted pass by pass, too.
const SPLIT_EVERY: u32 = 4;

/// A measurement under way.
struct Session<'a> {
    options: &'a BenchOptions,
    baseline: Option<Baseline>,
    interrupt: Interrupt,
    bar: ProgressBar,
    subjects: Vec<Subject>,
    loads: Loads,
    /// Complete rounds over all points.
    rounds: u32,
}

impl BenchOptions {
    /// A scene with what the options say of all.
    fn scene(&self, scene: Option<PathBuf>) -> SceneOptions {
        SceneOptions { scene, size: self.size, set: self.set.clone() }
    }
}

pub(super) fn run(options: &BenchOptions) -> Result<()> {
    check(options)?;
    let sources = sources(options);
    let mut session = Session {
        options,
        baseline: options.baseline.as_deref().map(Baseline::read).transpose()?,
        interrupt: Interrupt::listen()?,
        bar: progress(sources.len() as u64, options),
        subjects: Vec::new(),
        loads: Loads { before: None, during: None },
        rounds: 0,
    };
    session.set_up(sources)?;
    session.measure()?;
    session.bar.finish_and_clear();
    session.finish()
}

fn check(options: &BenchOptions) -> Result<()> {
    options.json.iter().try_for_each(|path| check_folder(path))?;
    options.scenes.iter().try_for_each(|scene| check_distinct(&options.json, Some(scene)))?;
    match (&options.json, &options.baseline) {
        (Some(json), Some(baseline)) if same_file(json, baseline) => Err(Error::usage(
            format!("{}: this is the baseline, and would be overwritten", json.display()),
            "give the new figures a file of their own",
        )),
        _ => Ok(()),
    }
}

/// Scene files first, then suites; the embedded scene where nothing is named.
fn sources(options: &BenchOptions) -> Vec<Source> {
    let files = options.scenes.iter().cloned().map(|path| Source::File(Some(path)));
    let sources: Vec<_> = files.chain(suites::cases(&options.suite).into_iter().map(Source::Suite)).collect();
    if sources.is_empty() { vec![Source::File(None)] } else { sources }
}

fn progress(points: u64, options: &BenchOptions) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(points * (1 + u64::from(options.warmup) + u64::from(options.frames)));
    match ProgressStyle::with_template("bench {bar:40} {percent} % {msg}, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

impl Session<'_> {
    /// Loads and warms up every point before any is measured.
    fn set_up(&mut self, sources: Vec<Source>) -> Result<()> {
        let start = Since::now();
        for source in sources {
            self.bar.set_message(source.name());
            let mut subject = Subject::new(source, self.options)?;
            self.baseline.iter().try_for_each(|old| old.check_device(subject.stage().device.info()))?;
            self.bar.inc(1);
            for _ in 0..self.options.warmup {
                self.stop_if_asked()?;
                subject.warm_up(self.options)?;
                self.bar.inc(1);
            }
            subject.count(self.options)?;
            self.subjects.push(subject);
        }
        self.stop_if_asked()?;
        let points: Vec<_> = self.subjects.iter().map(Subject::key).collect();
        self.baseline.iter().try_for_each(|old| old.check_points(&points))?;
        self.loads.before = start.load();
        self.loads.before.iter().for_each(|load| self.bar.suspend(|| load.warn("before the measurement")));
        Ok(())
    }

    fn stop_if_asked(&self) -> Result<()> {
        match self.interrupt.asked() {
            true => Err(Error::Interrupted("nothing was measured yet".into())),
            false => Ok(()),
        }
    }

    /// One repetition of each point after the other, so that whatever drifts on the machine is the same for all.
    fn measure(&mut self) -> Result<()> {
        let begin = Since::now();
        'rounds: while self.is_partial() {
            for subject in &mut self.subjects {
                if self.interrupt.asked() {
                    break 'rounds;
                }
                self.bar.set_message(subject.name());
                subject.measure(self.options, self.rounds.is_multiple_of(SPLIT_EVERY))?;
                self.bar.inc(1);
            }
            self.rounds += 1;
            self.save_so_far()?;
        }
        self.loads.during = begin.load();
        self.loads.during.iter().for_each(|load| self.bar.suspend(|| load.warn("during the measurement")));
        Ok(())
    }

    fn is_partial(&self) -> bool {
        self.rounds < self.options.frames
    }

    /// Keeps the rounds that are done, should the program be ended.
    fn save_so_far(&self) -> Result<()> {
        // What is no plain file, a pipe, gets the figures once, when they are complete.
        let plain = |path: &&Path| path.metadata().map_or(true, |metadata| metadata.is_file());
        match self.options.json.as_deref().filter(plain) {
            Some(path) if self.is_partial() => self.save(path, &self.points()),
            _ => Ok(()),
        }
    }

    /// Of what has been measured at least once.
    fn points(&self) -> Vec<Point> {
        self.subjects.iter().filter(|subject| !subject.whole.is_empty()).map(Point::new).collect()
    }

    fn save(&self, path: &Path, points: &[Point]) -> Result<()> {
        let Some(first) = self.subjects.first() else { return Ok(()) };
        let figures = Figures {
            origin: Origin::of(first.stage().device.info()),
            partial: self.is_partial(),
            set: &self.options.set,
            loads: self.loads,
            peak_host_mb: peak_host_memory().map(|bytes| bytes as f64 / MEGABYTE),
            baseline: self.baseline.as_ref(),
            points,
        };
        report::save(path, &figures)
    }

    /// Writes and prints everything.
    fn finish(&self) -> Result<()> {
        let mut points = self.points();
        self.baseline.iter().for_each(|baseline| baseline.compare(&mut points));
        self.options.json.iter().try_for_each(|path| self.save(path, &points))?;
        let measured = self.subjects.iter().filter(|subject| !subject.whole.is_empty());
        measured.zip(&points).try_for_each(|(subject, point)| show(subject, point))?;
        if let (Some(baseline), [first, ..]) = (&self.baseline, self.subjects.as_slice()) {
            baseline.introduce(first.stage().device.info(), &self.options.set)?;
            print_comparisons(&points)?;
        }
        self.subjects.iter().try_for_each(|subject| subject.stage().device.require_silence())?;
        match self.is_partial() {
            true => {
                Err(Error::Interrupted(format!("{} of {} rounds are done", self.rounds, self.options.frames)))
            }
            false => Ok(()),
        }
    }
}

/// Prints a point.
fn show(subject: &Subject, point: &Point) -> Result<()> {
    let stage = subject.stage();
    report::warn_of_overflow(&stage.frame.counters(), stage.render.max_lights_per_cluster);
    let [width, height] = point.size;
    let title = format!("{}, {width}x{height}, {}", point.scene, stage.device.info().name);
    report::print_table(&title, &point.passes, &subject.whole)?;
    point.pairs.iter().try_for_each(print)?;
    point.floors_ns.iter().try_for_each(print)
}
