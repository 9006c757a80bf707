//! amas: a Vulkan-native clustered-forward renderer for very many lights, with every picture's error known.
//!
//! The data flows one way:
//!
//! ```text
//! scene file ─▶ Scene (plain data) ─▶ GpuScene ─┐      ┌──────────────── Frame ────────────────┐
//!                                               ├────▶ │ prepass → cluster → direct → indirect → present │ ─▶ HdrImage, Timings
//!              camera, settings ─▶ FrameInputs ─┘      └───────────────────────────────────────┘
//!                    └──▶ reference (f64, no Vulkan) ─▶ compare
//! ```
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics fails"))]

pub mod compare;
pub mod error;
pub mod image;
pub mod reference;
pub mod scene;

pub use error::{Error, Result};
pub use image::HdrImage;
pub use scene::Scene;
