//! A tree over virtual lights, from which one is drawn by going down at random.
//!
//! Lights lie in the order of their normal's dominant axis and sign, and of a Hilbert curve for each of these six: nodes
//! but a few have cones of less than a hemisphere. They are the leaves of a complete binary heap.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::octahedral::{Cone, unpack_normal};
use super::trace::Proceed;
use crate::hilbert;
use crate::scene::PointLight;
use crate::shared::{VIRTUAL_ISOTROPIC, VirtualLight, VirtualNode};

/// Lights, and the tree over them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VirtualTree {
    /// In the order of the leaves.
    pub lights: Vec<VirtualLight>,
    /// Node 0 is none, node 1 the root; node i has the children 2i and 2i + 1, and node `leaves` + j is light j's.
    pub nodes: Vec<VirtualNode>,
    /// Leaves, a power of two, also of no lights.
    pub leaves: usize,
}

impl VirtualTree {
    /// The tree over lights on surfaces.
    #[must_use]
    pub fn new(lights: &[VirtualLight]) -> Self {
        Self::new_while(lights, &|| true).unwrap_or_default()
    }

    /// As [`VirtualTree::new`]; asks between its steps whether to go on. `None`
    /// where the answer was no.
    #[must_use]
    pub fn new_while(lights: &[VirtualLight], proceed: Proceed<'_>) -> Option<Self> {
        let mut classes: [Vec<u32>; 6] = Default::default();
        for (index, light) in (0..).zip(lights) {
            classes[class(light)].push(index);
        }
        let place = |&index: &u32| Vec3::from(lights[index as usize].position);
        let ordered = |class: &Vec<u32>| {
            let order = hilbert::order(class.iter().map(place));
            order.into_iter().map(|at| lights[class[at as usize] as usize]).collect::<Vec<_>>()
        };
        let parts = classes.par_iter().map(|class| proceed().then(|| ordered(class)));
        Self::over(parts.collect::<Option<Vec<_>>>()?.concat(), proceed)
    }

    /// The tree over point lights, relative to `origin`.
    #[must_use]
    pub fn of_points(lights: &[PointLight], origin: Vec3) -> Self {
        let order = hilbert::order(lights.iter().map(|light| light.position));
        let light = |index: u32| {
            let PointLight { position, intensity, range } = lights[index as usize];
            // The square of the smallest ranges is 0.
            let inverse = range.map_or(0.0, |range| (1.0 / (range * range)).min(f32::MAX));
            VirtualLight {
                position: (position - origin).to_array(),
                normal: VIRTUAL_ISOTROPIC,
                color: intensity.to_array(),
                extra: inverse.to_bits(),
            }
        };
        Self::over(order.into_iter().map(light).collect(), &|| true).unwrap_or_default()
    }

    /// The tree over lights in this order.
    fn over(lights: Vec<VirtualLight>, proceed: Proceed<'_>) -> Option<Self> {
        let leaves = lights.len().max(1).next_power_of_two();
        let mut nodes = vec![VirtualNode::default(); 2 * leaves];
        let mut level: Vec<Bundle> = lights.par_iter().map(Bundle::of).collect();
        let mut first = leaves;
        while proceed() {
            let below = &mut nodes[first..first + level.len()];
            below.par_iter_mut().zip(&level).for_each(|(node, bundle)| *node = bundle.node());
            if first == 1 {
                return Some(Self { lights, nodes, leaves });
            }
            level = level.par_chunks(2).map(|pair| pair[1..].iter().fold(pair[0], Bundle::with)).collect();
            first /= 2;
        }
        None
    }
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

    fn node(&self) -> VirtualNode {
        VirtualNode {
            lower: self.lower.to_array(),
            power: self.power.min(f64::from(f32::MAX)) as f32,
            upper: self.upper.to_array(),
            cone: if self.range > 0.0 { self.range.to_bits() } else { self.cone.pack() },
        }
    }
}
