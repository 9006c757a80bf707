//! Compiles `glsl/` to SPIR-V.
fn main() {}
