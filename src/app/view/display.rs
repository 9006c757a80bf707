//! The connection to the display, and what is said where there is none.

use super::Event;
use crate::error::{Error, Result};
use std::panic;
use winit::event_loop::EventLoop;

/// Connects to the display.
pub(super) fn connect() -> Result<EventLoop<Event>> {
    // winit panics where a library or an extension of the display is missing; its message belongs into the error.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let made = panic::catch_unwind(|| EventLoop::with_user_event().build());
    panic::set_hook(hook);
    match made {
        Ok(made) => made.map_err(|error| missing(&error.to_string())),
        Err(payload) => Err(missing(message(&*payload))),
    }
}

fn message(payload: &dyn std::any::Any) -> &str {
    payload
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no reason given")
}

/// There is no display, for a reason that winit gives.
pub(super) fn missing(reason: &str) -> Error {
    // winit's place in its own source says nothing to a user.
    let reason = reason
        .strip_prefix("os error at ")
        .and_then(|rest| rest.split_once(": "))
        .map_or(reason, |(_, reason)| reason);
    Error::NoDisplay {
        cause: format!("there is no display to open a window on ({})", reason.trim_end_matches('.')),
        remedy: "start it from a desktop session, and run ./setup for the display's libraries".into(),
    }
}

/// Whatever keeps the window shut, the same picture can be had without it.
pub(super) fn advise(error: Error) -> Error {
    let without = |remedy: String| format!("{remedy}; or use `amas render`, which needs no window");
    match error {
        Error::NoDevice { cause, remedy } => Error::NoDevice { cause, remedy: without(remedy) },
        Error::NoDisplay { cause, remedy } => Error::NoDisplay { cause, remedy: without(remedy) },
        other => other,
    }
}
