//! `occluded` of glsl/bind/bvh.glsl and hits of glsl/bind/hit.glsl on the device, unchanged, against double precision.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

#[path = "../common/mod.rs"]
mod common;
mod exact;
mod hits;
mod probe;
mod queries;
mod scenes;
mod soups;
mod speed;
mod starts;
mod surfaces;
