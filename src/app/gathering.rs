//! Gathered light where a picture is not refined until it is good enough: round by round.

pub(super) use super::refine::Rounds;

use crate::error::Result;
use crate::frame::Frame;
use crate::gpu::Device;
use std::sync::Arc;

/// Traces the lights of a round; `frame` gathers from them from now on.
pub(super) fn light(frame: &mut Frame, device: &Arc<Device>, rounds: &Rounds<'_>, number: u32) -> Result<()> {
    let round = rounds.round(number, &|| true);
    round.map_or(Ok(()), |round| {
        frame.set_gathered_lights(round.upload(device)?);
        Ok(())
    })
}
