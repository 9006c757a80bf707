//! Point lights that move: a group at a time, each place a closed form of time.

use super::PointLight;
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;
use std::ops::Range;

/// A group of point lights, and how it moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Indices into `Scene::point_lights`, which hold the places at time 0.
    pub lights: Range<usize>,
    /// The way they take.
    pub course: Course,
}

/// How a group of lights moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// The group turns about an axis, counter-clockwise as seen from its tip.
    Orbit {
        /// A point on the axis, world.
        center: DVec3,
        /// Unit.
        axis: DVec3,
        /// Seconds a turn.
        period: f64,
    },
    /// Every light goes straight on in a direction of its own, thrown back by the walls of a box.
    Drift {
        /// Metres a second.
        speed: f64,
        /// Chooses the directions.
        seed: u32,
        /// Corners of the box, which holds the group.
        walls: [DVec3; 2],
    },
}

impl Motion {
    /// Moves the group, whose `lights` are at their places of time 0, to time `t` in seconds.
    pub fn apply(&self, t: f64, lights: &mut [PointLight]) {
        match self.course {
            Course::Orbit { center, axis, period } => {
                let turn = DQuat::from_axis_angle(axis, TAU * (t / period).fract());
                for light in lights {
                    light.position = (center + turn * (light.position.as_dvec3() - center)).as_vec3();
                }
            }
            Course::Drift { speed, seed, walls } => {
                for (light, index) in lights.iter_mut().zip(0..) {
                    let way = direction(seed, index) * (speed * t);
                    light.position = fold(light.position.as_dvec3() + way, walls).as_vec3();
                }
            }
        }
    }
}

/// Uniform on the sphere, by Archimedes' theorem, from a hash of two words.
fn direction(seed: u32, index: u32) -> DVec3 {
    let mut bits = u64::from(seed) << 32 | u64::from(index);
    // The finaliser of SplitMix64 (Steele, Lea and Flood 2014).
    bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    let unit = |word: u64| (word as u32 as f64 + 0.5) / f64::from(1 << 16).powi(2);
    let z = 1.0 - 2.0 * unit(bits >> 32);
    let (sin, cos) = (TAU * unit(bits)).sin_cos();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

/// A place on a straight way, mirrored back into the box at every wall that the way crosses.
fn fold(p: DVec3, [lower, upper]: [DVec3; 2]) -> DVec3 {
    let size = upper - lower;
    let fold = |p: f64, lower: f64, size: f64| {
        if size <= 0.0 {
            return lower;
        }
        let along = (p - lower).rem_euclid(2.0 * size);
        lower + along.min(2.0 * size - along)
    };
    DVec3::new(fold(p.x, lower.x, size.x), fold(p.y, lower.y, size.y), fold(p.z, lower.z, size.z))
}
