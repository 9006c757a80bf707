//! Point lights that move: a group at a time, each place a closed form of time.

use super::PointLight;
use glam::{DQuat, DVec3, Vec3};
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

/// Where a course has taken its lights at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placement {
    /// Where they were at time 0.
    Still,
    /// See [`Course::Orbit`].
    Turned {
        /// A point on the axis, world.
        center: DVec3,
        /// About the axis.
        turn: DQuat,
    },
    /// See [`Course::Drift`].
    Drifted {
        /// Metres.
        way: f64,
        /// Lower and upper, of each axis.
        walls: [Walls; 3],
    },
}

/// Two walls that throw lights back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walls {
    lower: f64,
    size: f64,
    /// Of twice the size.
    inverse: f64,
}

impl Motion {
    /// Moves the group, whose `lights` are at their places of time 0, to time `t` in seconds.
    pub fn apply(&self, t: f64, lights: &mut [PointLight]) {
        let direction = |index| self.course.direction(index);
        let lights =
            lights.iter_mut().zip(0..).map(|(light, index)| (light.position, direction(index), light));
        self.course.at(t).place(lights, |light, position| light.position = position);
    }

    /// Metres a second that no light of the group, whose `lights` are at their places of time 0, exceeds.
    #[must_use]
    pub fn speed(&self, lights: &[PointLight]) -> f64 {
        match self.course {
            Course::Orbit { center, axis, period } => {
                let arm = |light: &PointLight| (light.position.as_dvec3() - center).cross(axis).length();
                TAU / period * lights.iter().map(arm).fold(0.0, f64::max)
            }
            Course::Drift { speed, .. } => speed,
        }
    }
}

impl Course {
    /// Time `t`, in seconds.
    #[must_use]
    pub fn at(&self, t: f64) -> Placement {
        match *self {
            Self::Orbit { center, axis, period } => {
                Placement::Turned { center, turn: DQuat::from_axis_angle(axis, TAU * (t / period).fract()) }
            }
            Self::Drift { speed, walls: [lower, upper], .. } => Placement::Drifted {
                way: speed * t,
                walls: std::array::from_fn(|axis| Walls::new(lower[axis], upper[axis])),
            },
        }
    }

    /// Unit direction of the group's light number `index`; 0 where they have none.
    #[must_use]
    pub fn direction(&self, index: u32) -> Vec3 {
        match *self {
            Self::Orbit { .. } => Vec3::ZERO,
            Self::Drift { seed, .. } => direction(seed, index).as_vec3(),
        }
    }
}

impl Placement {
    /// Hands on the places of lights, each of them where it was at time 0, its direction, and what is to have its place. What
    /// moves them is chosen once for all, so that the loop is one of arithmetic: a million lights take 10 CPU ms instead of
    /// 30.
    #[inline]
    pub fn place<T>(&self, lights: impl Iterator<Item = (Vec3, Vec3, T)>, mut then: impl FnMut(T, Vec3)) {
        match *self {
            Self::Still => lights.for_each(|(start, _, of)| then(of, start)),
            Self::Turned { center, turn } => lights.for_each(|(start, _, of)| {
                then(of, (center + turn * (start.as_dvec3() - center)).as_vec3());
            }),
            Self::Drifted { way, walls: [x, y, z] } => lights.for_each(|(start, direction, of)| {
                let p = start.as_dvec3() + direction.as_dvec3() * way;
                then(of, DVec3::new(x.fold(p.x), y.fold(p.y), z.fold(p.z)).as_vec3());
            }),
        }
    }
}

impl Walls {
    fn new(lower: f64, upper: f64) -> Self {
        let size = (upper - lower).max(0.0);
        Self { lower, size, inverse: 0.5 / size }
    }

    /// A place on a straight way, mirrored back at every wall that the way crosses: how far it is from the nearest of the
    /// lower wall's images, which lie two sizes apart.
    #[inline(always)]
    fn fold(self, p: f64) -> f64 {
        // Added and taken away again, 1.5 · 2⁵² rounds to the nearest integer: a remainder takes ten times as long.
        const ROUND: f64 = 6_755_399_441_055_744.0;
        let along = p - self.lower;
        let image = (along * self.inverse + ROUND) - ROUND;
        let from_wall = (along - image * (2.0 * self.size)).abs();
        // Not `min`: between walls without a distance it is NaN.
        self.lower + if from_wall < self.size { from_wall } else { self.size }
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
