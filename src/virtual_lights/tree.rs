//! A tree over virtual lights, from which one is drawn by going down at random.
//!
//! Lights whose normals have another dominant axis or sign come apart first: nodes but a few have cones of less than a
//! hemisphere. Then a node's box is halved across its longest side. A walk is only as good as each of its choices: where a
//! node holds lights from here and from far away, those here are drawn too seldom, on every level down to where they come
//! apart. A heap over the lights along a Hilbert curve, with as many in each half, has such nodes wherever the curve leaves a
//! surface: in `scenes/indirect.toml`, of 65,536 lights one drawn for places on other lights had a second moment of 129, and
//! one was worth up to 2e8 of what all give together; halved boxes have 1.9 and 28.

use glam::{DVec3, Vec3};

use super::octahedral::{Cone, unpack_normal};
use super::trace::Proceed;
use crate::scene::PointLight;
use crate::shared::{VIRTUAL_ISOTROPIC, VirtualLight, VirtualPair};

/// Lights of a node whose children are made side by side, and asked for whether to go on.
const LARGE: usize = 4096;

/// Lights, and the tree over them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VirtualTree {
    /// In the order of a walk through the tree that goes left first.
    pub lights: Vec<VirtualLight>,
    /// Nodes of two lights and more, in that order: the root is the first, and there is one less than there are lights.
    pub pairs: Vec<VirtualPair>,
}

impl VirtualTree {
    /// The tree over lights on surfaces.
    #[must_use]
    pub fn new(lights: &[VirtualLight]) -> Self {
        Self::new_while(lights, &|| true).unwrap_or_default()
    }

    /// As [`VirtualTree::new`]; asks now and then whether to go on. `None` where the answer was no.
    #[must_use]
    pub fn new_while(lights: &[VirtualLight], proceed: Proceed<'_>) -> Option<Self> {
        let mut classes: [Vec<VirtualLight>; 6] = Default::default();
        for light in lights {
            classes[class(light)].push(*light);
        }
        let sizes: Vec<usize> = classes.iter().map(Vec::len).filter(|&size| size > 0).collect();
        Self::over(classes.concat(), &sizes, proceed)
    }

    /// The tree over point lights, relative to `origin`.
    #[must_use]
    pub fn of_points(lights: &[PointLight], origin: Vec3) -> Self {
        let light = |light: &PointLight| {
            let PointLight { position, intensity, range } = *light;
            // The square of the smallest ranges is 0.
            let inverse = range.map_or(0.0, |range| (1.0 / (range * range)).min(f32::MAX));
            VirtualLight {
                position: (position - origin).to_array(),
                normal: VIRTUAL_ISOTROPIC,
                color: intensity.to_array(),
                extra: inverse.to_bits(),
            }
        };
        Self::over(lights.iter().map(light).collect(), &[lights.len()], &|| true).unwrap_or_default()
    }

    /// The tree over lights that come in classes of these sizes.
    fn over(mut lights: Vec<VirtualLight>, sizes: &[usize], proceed: Proceed<'_>) -> Option<Self> {
        let mut pairs = vec![VirtualPair::default(); lights.len().saturating_sub(1)];
        if !lights.is_empty() {
            grow(&mut lights, sizes, &mut pairs, proceed)?;
        }
        Some(Self { lights, pairs })
    }
}

/// Brings lights, of which there are some, into the order of their nodes.
fn grow(
    lights: &mut [VirtualLight],
    sizes: &[usize],
    pairs: &mut [VirtualPair],
    proceed: Proceed<'_>,
) -> Option<Bundle> {
    let Some((pair, below)) = pairs.split_first_mut() else { return Some(Bundle::of(&lights[0])) };
    let (left_sizes, right_sizes) = sizes.split_at(sizes.len() / 2);
    let left_count = if left_sizes.is_empty() { halve(lights) } else { left_sizes.iter().sum() };
    let large = lights.len() >= LARGE;
    let (left_lights, right_lights) = lights.split_at_mut(left_count);
    let (left_pairs, right_pairs) = below.split_at_mut(left_count - 1);
    let left_sizes = if left_sizes.is_empty() { sizes } else { left_sizes };
    let mut left = || grow(left_lights, left_sizes, left_pairs, proceed);
    let mut right = || grow(right_lights, right_sizes, right_pairs, proceed);
    let (left, right) = if !large {
        (left(), right())
    } else if proceed() {
        rayon::join(left, right)
    } else {
        return None;
    };
    let (left, right) = (left?, right?);
    *pair = left.beside(&right, left_count);
    Some(left.with(&right))
}

/// Of two lights or more, those in the lower half of their box along its longest side come first: how many they are. Half of
/// them where all are at one place.
fn halve(lights: &mut [VirtualLight]) -> usize {
    let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (lower, upper) = lights.iter().fold(nothing, |(lower, upper), light| {
        let place = Vec3::from(light.position);
        (lower.min(place), upper.max(place))
    });
    let axis = (0.5 * upper - 0.5 * lower).max_position();
    let middle = 0.5 * lower[axis] + 0.5 * upper[axis];
    let mut below = 0;
    for index in 0..lights.len() {
        if lights[index].position[axis] < middle {
            lights.swap(index, below);
            below += 1;
        }
    }
    if (1..lights.len()).contains(&below) { below } else { lights.len() / 2 }
}

/// The normal's dominant axis and sign.
fn class(light: &VirtualLight) -> usize {
    let normal = unpack_normal(light.normal);
    let axis = normal.abs().max_position();
    2 * axis + usize::from(normal[axis] < 0.0)
}

/// Some lights together.
#[derive(Clone, Copy)]
struct Bundle {
    lower: Vec3,
    upper: Vec3,
    power: f64,
    cone: Cone,
    // Of isotropic lights the largest, infinite where one has none; 0 of others.
    range: f32,
}

impl Bundle {
    fn of(light: &VirtualLight) -> Self {
        let isotropic = light.normal == VIRTUAL_ISOTROPIC;
        let cone = if isotropic { Cone::SPHERE } else { Cone::along(unpack_normal(light.normal)) };
        let place = Vec3::from(light.position);
        let power = DVec3::from_array(light.color.map(f64::from)).element_sum() / 3.0;
        let inverse2 = f32::from_bits(light.extra);
        let range = if isotropic { inverse2.sqrt().recip() } else { 0.0 };
        Self { lower: place, upper: place, power, cone, range }
    }

    fn with(self, other: &Self) -> Self {
        Self {
            lower: self.lower.min(other.lower),
            upper: self.upper.max(other.upper),
            power: self.power + other.power,
            cone: self.cone.around(other.cone),
            range: self.range.max(other.range),
        }
    }

    /// Both as a node's children.
    fn beside(&self, right: &Self, left_count: usize) -> VirtualPair {
        VirtualPair {
            left_lower: self.lower.to_array(),
            left_count: left_count as u32,
            left_upper: self.upper.to_array(),
            left_cone: self.cone(),
            right_lower: right.lower.to_array(),
            powers: upper_half(self.power) | upper_half(right.power) << 16,
            right_upper: right.upper.to_array(),
            right_cone: right.cone(),
        }
    }

    fn cone(&self) -> u32 {
        if self.range > 0.0 { self.range.to_bits() } else { self.cone.pack() }
    }
}

/// The upper half of a number's bits as a float, to .4 %; of what is not 0, neither 0 nor infinite.
fn upper_half(power: f64) -> u32 {
    let bits = ((power.min(f64::from(f32::MAX)) as f32).to_bits() + 0x8000) >> 16;
    if power > 0.0 { bits.clamp(f32::MIN_POSITIVE.to_bits() >> 16, f32::MAX.to_bits() >> 16) } else { 0 }
}
