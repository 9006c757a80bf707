//! The oracle: double precision, on the CPU, written from the papers.
pub mod bsdf;
mod sampler;
