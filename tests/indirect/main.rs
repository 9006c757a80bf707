//! Indirect light and the shadows of point lights, as the device gathers them, against paths in double precision and laws.
//! Every test runs under the validation layers with synchronisation checks, and one message fails it.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

#[path = "../common/mod.rs"]
mod common;

mod hard;
mod laws;
mod materials;
mod points;
mod support;
mod visibility;
mod worlds;
