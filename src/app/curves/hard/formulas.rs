//! What a formula is. A further one is a row of `bsdf.rs` or `area.rs` with its cases, its number in `shared.rs`, and a line
//! in glsl/probe/hard.comp or hard_area.comp.

use super::{area, bsdf};
use crate::error::Result;
use crate::gpu::Shader;
use crate::ltc::{Tables, tables};
use crate::reference::sampler::Random;
use glam::{DVec4, Vec4};

/// Four slots of four numbers that float32 holds; `HardProbeRow` says of what.
pub(super) type Slots = [[f32; 4]; 4];

/// How a row is made.
enum Make {
    Plain(fn(&mut Random) -> Slots),
    /// With numbers of transformed cosines.
    Fitted(fn(&mut Random, &Tables) -> Slots),
}

/// Inputs of a kind.
pub(super) struct Case {
    pub(super) name: &'static str,
    make: Make,
    /// Values above which the usual form has digits in double precision.
    #[cfg_attr(not(test), expect(dead_code, reason = "only the test of the table asks"))]
    pub(super) plain: f64,
    /// Errors are absolute: values may be 0.
    pub(super) absolute: bool,
}

impl Case {
    /// So many.
    ///
    /// # Errors
    /// As [`tables`].
    pub(super) fn rows(&self, random: &mut Random, count: usize) -> Result<Vec<Slots>> {
        Ok(match self.make {
            Make::Plain(make) => (0..count).map(|_| make(random)).collect(),
            Make::Fitted(make) => {
                let tables = tables()?;
                (0..count).map(|_| make(random, tables)).collect()
            }
        })
    }
}

/// A formula in two forms.
pub(super) struct Formula {
    /// `HARD_*`.
    pub(super) number: u32,
    /// The probe that has it.
    pub(super) shader: Shader,
    pub(super) name: &'static str,
    /// How it is usually written.
    pub(super) naive_text: &'static str,
    pub(super) shipped_text: &'static str,
    pub(super) naive: fn(&[Vec4; 4]) -> f32,
    #[cfg_attr(not(test), expect(dead_code, reason = "only the test of the table asks"))]
    pub(super) exact_naive: fn(&[DVec4; 4]) -> f64,
    /// `None` where only the device has it.
    pub(super) shipped: Option<fn(&[Vec4; 4]) -> f32>,
    /// In double precision: the form that ships, or a way of its own.
    pub(super) truth: fn(&[DVec4; 4]) -> f64,
    /// Slots whose directions are judged as unit vectors; none where both forms ask for the half vector's direction only.
    pub(super) directions: usize,
    pub(super) cases: &'static [Case],
}

/// All of them.
pub(super) fn formulas() -> impl Iterator<Item = &'static Formula> {
    bsdf::FORMULAS.iter().chain(area::FORMULAS)
}

pub(super) const fn relative(name: &'static str, make: fn(&mut Random) -> Slots, plain: f64) -> Case {
    Case { name, make: Make::Plain(make), plain, absolute: false }
}

pub(super) const fn absolute(name: &'static str, make: fn(&mut Random) -> Slots, plain: f64) -> Case {
    Case { name, make: Make::Plain(make), plain, absolute: true }
}

/// As [`relative`], with the tables of transformed cosines.
pub(super) const fn fitted(name: &'static str, make: fn(&mut Random, &Tables) -> Slots, plain: f64) -> Case {
    Case { name, make: Make::Fitted(make), plain, absolute: false }
}
