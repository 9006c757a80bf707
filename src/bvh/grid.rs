//! Boxes in 16-bit cells of a grid over the tree: a node is one texel, which is most of what a step of a walk costs.

use super::split::Bounds;
use crate::shared::BVH_CELLS;
use glam::{DVec3, Vec3};

/// A grid whose cells numbered 0 and `BVH_CELLS` lie at the tree's corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub(super) lower: Vec3,
    pub(super) cell: Vec3,
}

impl Grid {
    /// Of a tree without nodes.
    pub(super) const UNIT: Self = Self { lower: Vec3::ZERO, cell: Vec3::ONE };

    pub(super) fn new(bounds: &Bounds) -> Self {
        let side = bounds.upper - bounds.lower;
        // A flat tree has cells all the same, and a little more room than its box keeps the last one in.
        let largest = bounds.upper.abs().max(bounds.lower.abs()).max_element();
        let side = side.max(Vec3::splat((1e-6 * largest).max(1e-20)));
        Self { lower: bounds.lower, cell: side * (1.000_001 / BVH_CELLS as f32) }
    }

    /// A box in cells, rounded outwards: lower corner | upper corner << 16, for each axis.
    pub(super) fn cells(&self, bounds: &Bounds) -> [u32; 3] {
        let place = |corner: Vec3| (corner.as_dvec3() - self.lower.as_dvec3()) / self.cell.as_dvec3();
        let clamp = |place: DVec3| place.clamp(DVec3::ZERO, DVec3::splat(f64::from(BVH_CELLS)));
        let (lower, upper) = (clamp(place(bounds.lower).floor()), clamp(place(bounds.upper).ceil()));
        std::array::from_fn(|axis| lower[axis] as u32 | (upper[axis] as u32) << 16)
    }
}
