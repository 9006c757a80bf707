//! The frame against the oracle and against laws that any picture obeys. Every test runs under the validation layers
//! with synchronisation checks, and one message fails it.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

#[path = "../common/mod.rs"]
mod common;

mod area;
mod area_cells;
mod area_shadows;
mod cameras;
mod clusters;
mod cut;
mod cut_worlds;
mod edits;
mod encodings;
mod far;
mod folds;
mod front_ends;
mod light_textures;
mod lists;
mod luminaires;
mod motion;
mod oracle;
mod order;
mod pick;
mod support;
mod surfaces;
mod textures;
mod wireframe;
