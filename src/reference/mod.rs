//! The oracle: double precision, on the CPU, written from the papers and not from the shaders.
//!
//! Exact up to rounding: camera rays and hits ([`rays`]), shading frames and BSDFs ([`shading`], [`bsdf`]), the sum over
//! point lights ([`lights`]), what stands between a light and a surface ([`visibility`]). An unbiased
//! estimate with its standard error: area lights ([`area`]), full light transport, and pixels of more than one ray
//! ([`render()`]).

pub mod area;
pub mod bsdf;
pub mod lights;
mod path;
pub mod rays;
mod render;
pub(crate) mod sampler;
pub mod shading;
pub(crate) mod texture;
mod tree;
pub mod visibility;

pub use render::{Integrator, Options, Oracle, Rendered, render};
