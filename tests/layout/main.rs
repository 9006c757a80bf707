//! `src/shared.rs` against the SPIR-V that ships: layouts, bindings, workgroups, specialisation constants, limits.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod bindings;
mod limits;
mod spirv;
mod structs;

use amas::gpu::{Shader, shaders};
use spirv::Module;

/// Every shader that ships, with ray queries and without.
fn modules() -> impl Iterator<Item = (Shader, Module)> {
    kinds().map(|(shader, ray_queries)| (shader, Module::parse(&shader.words(ray_queries))))
}

/// Every shader, and whether with ray queries.
fn kinds() -> impl Iterator<Item = (Shader, bool)> {
    shaders::ALL.iter().flat_map(|&shader| shader.kinds().map(move |ray_queries| (shader, ray_queries)))
}

/// The value of a constant that `shared.rs` hands to GLSL.
fn constant(name: &str) -> Option<u32> {
    constants().find(|&(found, _)| found == name).map(|found| found.1)
}

fn constants() -> impl Iterator<Item = (&'static str, u32)> {
    amas::shared::GLSL.lines().filter_map(|line| {
        let (name, value) = line.strip_prefix("#define ")?.split_once(' ')?;
        Some((name, value.trim_end_matches('u').parse().ok()?))
    })
}
