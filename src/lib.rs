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

pub mod app;
pub mod camera_constants;
pub mod compare;
pub mod draws;
pub mod error;
pub mod frame;
#[allow(unsafe_code, reason = "the one layer that calls Vulkan")]
pub mod gpu;
pub mod gpu_scene;
pub mod image;
pub mod light_tree;
pub mod passes;
pub mod probe;
pub mod reference;
pub mod scene;
pub mod shared;
pub mod targets;

pub use error::{Error, Result};
pub use frame::{Frame, FrameInputs, FrameSettings, Timings};
pub use gpu::Device as Gpu;
pub use gpu_scene::GpuScene;
pub use image::HdrImage;
pub use scene::Scene;
