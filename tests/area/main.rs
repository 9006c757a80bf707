//! The shipped GLSL geometry of area lights on a device: against closed forms, and against sums in double precision.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

#[path = "../common/mod.rs"]
mod common;

mod azimuths;
mod closed_forms;
mod ellipses;
mod estimators;
mod furnace;
mod hard;
mod limits;
mod lines;
mod mirror;
mod probe;
mod truth;
