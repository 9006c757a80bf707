//! Lights that stand for reflected light: paths from every emitter leave them on surfaces ([`Tracer`]), and a tree over
//! them lets a receiver choose one by what it may get ([`VirtualTree`]). Plain data, no Vulkan; in double precision until
//! it is stored.

mod area;
pub mod emit;
mod lambert;
pub mod octahedral;
mod steps;
mod trace;
mod tree;

pub use lambert::lambert;
pub use trace::{Proceed, Tracer};
pub use tree::VirtualTree;

use glam::{DVec3, Vec3};
use octahedral::pack_normal;

use crate::hilbert;
use crate::shared::VirtualLight;

/// One round's lights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightSet {
    /// Points on area lights, each in proportion to its power; their depth is 0. The scene's point lights and its
    /// background are not among them.
    pub emitters: Vec<VirtualLight>,
    /// Reflected light, in the order of the paths.
    pub bounced: Vec<VirtualLight>,
    /// Median distance between bounced lights that are neighbours along a Hilbert curve, metres; 0 of fewer than two.
    pub spacing: f32,
    /// Light paths that left the bounced lights.
    pub paths: usize,
}

/// A light moves off its surface by this share of the largest coordinate in play: 32 steps of float32, so that shadow
/// rays to it do not meet the surface.
const OFFSET: f64 = 1.0 / (1 << 19) as f64;

/// The light at a place relative to the device's origin, on a surface whose largest coordinate is `reach`.
fn light_at(position: DVec3, normal: DVec3, reach: f64, color: DVec3, depth: u32) -> VirtualLight {
    VirtualLight {
        position: (position + normal * (OFFSET * reach)).as_vec3().to_array(),
        normal: pack_normal(normal),
        color: color.min(DVec3::splat(f64::from(f32::MAX))).as_vec3().to_array(),
        extra: depth,
    }
}

fn spacing(lights: &[VirtualLight]) -> f32 {
    let place = |light: &VirtualLight| Vec3::from(light.position);
    let order = hilbert::order(lights.iter().map(place));
    let distance = |pair: &[u32]| place(&lights[pair[0] as usize]).distance(place(&lights[pair[1] as usize]));
    let mut distances: Vec<f32> = order.windows(2).map(distance).collect();
    let middle = distances.len() / 2;
    if distances.is_empty() { 0.0 } else { *distances.select_nth_unstable_by(middle, f32::total_cmp).1 }
}
