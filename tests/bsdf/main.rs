//! The shipped GLSL of the BSDFs on a device: against pbrt's tables, against the oracle, and against the laws.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

#[path = "../common/mod.rs"]
mod common;

mod albedo;
mod chi_square;
mod laws;
mod mixed;
mod oracle;
mod probe;
mod random;
mod sampling;
mod tables;
