//! `src/shared.rs` against the SPIR-V that ships: layouts, bindings, workgroups, specialisation constants, limits.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod bindings;
mod limits;
mod spirv;
mod structs;

use amas::gpu::{Shader, shaders};
use spirv::Module;

/// Every shader that ships.
fn modules() -> impl Iterator<Item = (Shader, Module)> {
    let all = shaders::ALL.iter();
    all.map(|&shader| (shader, Module::parse(&shader.words())))
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
