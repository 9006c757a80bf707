//! Gathered light of `amas render`: rounds until the picture is good enough.

use super::args::{INDIRECT_ERROR, RefineOptions};
use super::interrupt::Interrupt;
use super::terminal::{complain, percent, print};
use crate::error::{Error, Result};
use crate::frame::{Frame, FrameInputs, Timings};
use crate::gpu::Device;
use crate::passes::gather::Gathered;
use crate::refine::Rounds;
use indicatif::ProgressBar;
use std::io::IsTerminal;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Pictures that are refined, one after the other.
pub(super) struct Refining<'a> {
    goal: &'a RefineOptions,
    interrupt: Interrupt,
    /// Estimated relative error of each picture, where it is known.
    errors: Vec<Option<f64>>,
}

impl<'a> Refining<'a> {
    /// Where there is anything to be gathered.
    pub(super) fn start(goal: &'a RefineOptions, wanted: Gathered) -> Result<Option<Self>> {
        if wanted.anything() {
            return Ok(Some(Self { goal, interrupt: Interrupt::listen()?, errors: Vec::new() }));
        }
        if goal.indirect_error.is_some() || goal.time_limit.is_some() {
            complain(
                "warning: no light is gathered here, so --indirect-error and --time-limit mean nothing\n  remedy: ask for indirect \
                 light, such as --set indirect.vpls=16384, or for shadows of point lights, --set shadows=true; or leave them out",
            );
        }
        Ok(None)
    }

    /// Refines the picture last rendered until it is good enough, and says how far it came.
    pub(super) fn refine(
        &mut self,
        frame: &mut Frame,
        rounds: &Rounds<'_>,
        device: &Arc<Device>,
        inputs: &FrameInputs<'_>,
    ) -> Result<Timings> {
        let start = Instant::now();
        let late = || self.goal.time_limit.is_some_and(|limit| start.elapsed().as_secs_f64() >= limit);
        let proceed = || !late() && !self.interrupt.asked();
        let bar = spinner();
        let mut timings = Timings::default();
        let error = loop {
            timings.add(&rounds.add(frame, device, inputs, &proceed)?);
            let error = frame.gathered_error()?;
            bar.set_message(progress(frame.gathered(), error));
            if self.reached(error) || !proceed() {
                break error;
            }
        };
        bar.finish_and_clear();
        print(progress(frame.gathered(), error))?;
        if !self.reached(error) && !self.interrupted() {
            complain(format_args!(
                "warning: the time limit came before the error was below {}\n  remedy: raise --time-limit, or --indirect-error",
                percent(self.wanted())
            ));
        }
        self.errors.push(error);
        Ok(timings)
    }

    fn reached(&self, error: Option<f64>) -> bool {
        error.is_some_and(|error| error <= self.wanted())
    }

    fn wanted(&self) -> f64 {
        self.goal.indirect_error.unwrap_or(INDIRECT_ERROR)
    }

    /// Whether the user asked to stop.
    pub(super) fn interrupted(&self) -> bool {
        self.interrupt.asked()
    }

    /// The largest error of any picture; `None` where one is unknown.
    pub(super) fn worst(&self) -> Option<f64> {
        self.errors.iter().copied().try_fold(0.0, |worst: f64, error| Some(worst.max(error?)))
    }

    /// An error where not all was done that was asked for.
    pub(super) fn end(self) -> Result<()> {
        if !self.interrupted() {
            return Ok(());
        }
        Err(Error::Interrupted(match self.errors.len() {
            1 => "the picture is saved as far as it came".into(),
            several => format!("{several} pictures are saved, the last as far as it came"),
        }))
    }
}

fn progress(frames: u32, error: Option<f64>) -> String {
    let known = error.map_or_else(
        || "unknown before two rounds".into(),
        |error| format!("{} of the picture's mean", percent(error)),
    );
    let plural = if frames == 1 { "" } else { "s" };
    format!("gathered light: {frames} frame{plural}, estimated error {known}")
}

/// On a terminal; nothing in a pipe.
fn spinner() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_far_it_came() {
        assert_eq!(progress(1, None), "gathered light: 1 frame, estimated error unknown before two rounds");
        let done = "gathered light: 32 frames, estimated error 1.25 % of the picture's mean";
        assert_eq!(progress(32, Some(0.0125)), done);
    }
}
