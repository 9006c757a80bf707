//! Gathered light of the picture at rest: indirect light, and that of point lights with shadows.
//!
//! Frame by frame, and within a frame slice by slice ([`Pace`]). Lights do not depend on the view: a picture begins with those
//! that its frame has, and each round after its first asks for others, so that no picture has the same twice.

use super::Event;
use super::pace::Pace;
use super::supply::{Lights, Supply};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, Timings};
use crate::gpu::Device;
use crate::passes::gather::Gathered;
use crate::scene::{RenderSettings, Scene};
use crate::shared::GATHER_FRAMES;
use std::sync::Arc;
use winit::event_loop::EventLoopProxy;

/// Estimated relative error at which the picture is good enough.
const GOAL: f64 = 0.002;
/// Rounds, beyond those that an estimate was made of, after which the next is made, as a share: it costs as much as some
/// slices, and the error falls as their root.
const NEXT_ESTIMATE: f64 = 1.25;

/// How far the picture's gathered light is.
#[derive(Default)]
pub(super) struct Gathering {
    /// With the number of lights and of bounces that it is for.
    supply: Option<(Supply, [u32; 2])>,
    /// Of the lights that the frame has: how many stand for reflected light.
    virtuals: Option<usize>,
    /// The picture's round that they serve.
    round: Option<u32>,
    pace: Pace,
    /// The last estimate, and its rounds.
    estimate: Option<(Option<f64>, u32)>,
    /// Of the slices of the frame that is being gathered.
    timings: Timings,
    state: State,
}

/// What is being done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    /// Nothing, because the view moves, or has samples to come.
    #[default]
    Waiting,
    /// The round's lights are being made.
    Tracing,
    Gathering,
    /// The error is as small as it is wanted.
    Done,
}

/// Figures for the overlay.
#[derive(Clone, Copy, Debug)]
pub(super) struct Status {
    pub(super) what: Gathered,
    pub(super) state: State,
    pub(super) frames: u32,
    pub(super) rounds: u32,
    /// Estimated, relative.
    pub(super) error: Option<f64>,
    /// Lights of the set that stand for reflected light.
    pub(super) virtuals: Option<usize>,
}

/// What a slice came to.
pub(super) enum Done {
    /// There is nothing to do, or not yet.
    Nothing,
    /// A part of a frame.
    Part,
    /// A frame, with what it took: the picture shows it.
    Frame(Timings),
    /// The state has changed, as the overlay says.
    State,
}

/// Where lights come from.
pub(super) struct Origin<'a> {
    pub(super) device: &'a Arc<Device>,
    pub(super) scene: &'a Arc<Scene>,
    pub(super) proxy: &'a EventLoopProxy<Event>,
}

impl Gathering {
    /// The scene is another one: so are its lights.
    pub(super) fn forget(&mut self) {
        *self = Self { pace: std::mem::take(&mut self.pace), ..Self::default() };
    }

    /// The picture begins anew; lights stay.
    pub(super) fn restart(&mut self) {
        self.round = None;
        self.estimate = None;
        self.timings = Timings::default();
        self.state = State::Waiting;
    }

    /// Keeps the making of lights waiting, or lets it go on.
    pub(super) fn pause(&self, paused: bool) {
        if let Some((supply, _)) = &self.supply {
            supply.pause(paused);
        }
    }

    /// Whether the frame has lights to gather from.
    pub(super) fn has_lights(&self) -> bool {
        self.virtuals.is_some()
    }

    /// Whether the lights, if there are any, are those that a scene with these settings has.
    pub(super) fn serves(&self, render: &RenderSettings) -> bool {
        self.supply.as_ref().is_none_or(|(_, traced)| *traced == [render.vpls, render.bounces])
    }

    pub(super) fn status(&self, frame: &Frame) -> Option<Status> {
        let what = frame.gathers();
        let frames = frame.gathered();
        let scaled = |(error, rounds): (Option<f64>, u32)| {
            let frames_then = f64::from(rounds * GATHER_FRAMES);
            error.map(|error| error * (frames_then / f64::from(frames.max(1))).sqrt())
        };
        what.anything().then(|| Status {
            what,
            state: self.state,
            frames,
            rounds: frames / GATHER_FRAMES,
            error: self.estimate.and_then(scaled),
            virtuals: self.virtuals,
        })
    }

    /// Goes on with a picture that has its samples, the last of which took so many milliseconds; of a preview it only makes
    /// ready what the picture in its place will need.
    pub(super) fn step(
        &mut self,
        frame: &mut Frame,
        origin: &Origin<'_>,
        inputs: &FrameInputs<'_>,
        (direct, preview): (f64, bool),
    ) -> Result<Done> {
        if !frame.gathers().anything() || self.state == State::Done {
            return Ok(Done::Nothing);
        }
        let before = self.state;
        self.state = match frame.rows_gathered() == 0 {
            true => self.begin(frame, origin)?,
            false => State::Gathering,
        };
        if self.state != State::Gathering || preview {
            return Ok(if self.state == before { Done::Nothing } else { Done::State });
        }
        let slice = self.pace.slice(frame.rows_gathered(), frame.rows_to_gather(), direct);
        let timings = frame.gather_rows(inputs, slice.rows)?;
        self.pace.took(slice, timings.wall_ms);
        self.timings.add(&timings);
        Ok(match slice.ends() {
            true => Done::Frame(std::mem::take(&mut self.timings)),
            false if self.state != before => Done::State,
            false => Done::Part,
        })
    }

    /// Makes ready for a frame: estimates the error where that is due, and has lights for the round.
    fn begin(&mut self, frame: &mut Frame, origin: &Origin<'_>) -> Result<State> {
        let round = frame.gathered() / GATHER_FRAMES;
        if frame.gathered().is_multiple_of(GATHER_FRAMES) && self.round != Some(round) {
            if self.is_due(round) {
                let error = frame.gathered_error()?;
                self.estimate = Some((error, round));
                if error.is_some_and(|error| error <= GOAL) {
                    return Ok(State::Done);
                }
            }
            if !self.feed(frame, round, origin)? {
                return Ok(State::Tracing);
            }
            self.round = Some(round);
        }
        Ok(State::Gathering)
    }

    fn is_due(&self, rounds: u32) -> bool {
        let next = self.estimate.map_or(2, |(_, last)| (f64::from(last) * NEXT_ESTIMATE).ceil() as u32);
        // Not twice, where lights were not ready.
        rounds >= next && self.estimate.is_none_or(|(_, last)| last != rounds)
    }

    /// Has the frame gather from lights for that round; whether there are any yet.
    fn feed(&mut self, frame: &mut Frame, round: u32, origin: &Origin<'_>) -> Result<bool> {
        let what = frame.gathers();
        if self.virtuals.is_some() && (round == 0 || !what.indirect) {
            return Ok(true);
        }
        let (supply, _) = self.supply.get_or_insert_with(|| {
            let RenderSettings { vpls, bounces, .. } = origin.scene.render;
            let of = (frame.scene().origin, what);
            (Supply::start(origin.device, origin.scene, of, origin.proxy), [vpls, bounces])
        });
        let Some(Lights { lights, virtuals }) = supply.take()? else { return Ok(false) };
        frame.set_gathered_lights(lights);
        self.virtuals = Some(virtuals);
        Ok(true)
    }
}
