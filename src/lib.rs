//! amas: a Vulkan-native clustered-forward renderer for very many lights, with every picture's error known.
//!
//! The data flows one way:
//!
//! ```text
//! scene file ─▶ Scene ───────▶ GpuScene ──┐      ┌───────────────────── Frame ─────────────────────┐
//!               plain data     on device  ├────▶ │ prepass → cluster → direct → indirect → present │ ─▶ HdrImage, Timings
//! camera, settings ────────▶ FrameInputs ─┘      └─────────────────────────────────────────────────┘         │
//!               └──▶ reference (f64, no Vulkan) ───────────────────────────────────────────────────▶ compare
//! ```
//!
//! Modules import only from those above them:
//!
//! | module | what |
//! | --- | --- |
//! | [`shared`] | what Rust and GLSL both know, declared once |
//! | [`error`] | the one error type: cause, remedy, exit status |
//! | [`mod@image`] | scene-linear pictures and their files |
//! | [`mod@compare`] | error figures between two pictures |
//! | [`scene`] | what the world is, as plain data, and how it is loaded |
//! | [`mod@reference`] | the oracle in double precision, without Vulkan |
//! | [`ltc`] | area lights by linearly transformed cosines: tables, and their fitter |
//! | [`gpu`] | thin safe layer over `ash`, the only module with `unsafe` |
//! | [`hilbert`] | the order of points along a Hilbert curve |
//! | [`light_tree`] | lights in Hilbert order, the tree over them, and one with moments over lights without a range |
//! | [`area_lights`] | area lights as texels: outlines, convex pieces, cubature, textures |
//! | [`bvh`] | a tree over what hides lights: triangles, masks, luminaires |
//! | [`virtual_lights`] | light paths from every emitter, the lights they leave on surfaces, a tree to choose them by |
//! | [`camera_constants`] | from a camera to what the shaders know of it |
//! | [`draws`] | runs of triangles: which a camera can see, and from which side |
//! | [`gpu_scene`] | the scene on the device |
//! | [`targets`] | every image the frame renders into |
//! | [`passes`] | one file a pass |
//! | [`frame`] | the frame: passes in order, and the barriers between them |
//! | [`mod@refine`] | rounds of gathered light, until a picture is good enough |
//! | [`probe`] | how tests call the shaders' library |
//! | [`app`] | the subcommands |
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics fails"))]

pub mod app;
pub mod area_lights;
pub mod bvh;
pub mod camera_constants;
pub mod compare;
pub mod draws;
pub mod error;
pub mod frame;
#[allow(unsafe_code, reason = "the one layer that calls Vulkan")]
pub mod gpu;
pub mod gpu_scene;
pub mod hilbert;
pub mod image;
pub mod light_tree;
pub mod ltc;
pub mod passes;
pub mod probe;
pub mod reference;
pub mod refine;
pub mod scene;
pub mod shared;
pub mod targets;
pub mod virtual_lights;

pub use error::{Error, Result};
pub use frame::{Frame, FrameInputs, FrameSettings, Timings};
pub use gpu::Device as Gpu;
pub use gpu_scene::GpuScene;
pub use image::HdrImage;
pub use scene::Scene;
