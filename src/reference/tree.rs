//! A bounding volume hierarchy in double precision, over boxes: triangles for rays, light ranges for points.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least corner.
    pub min: DVec3,
    /// Greatest corner.
    pub max: DVec3,
}

impl Bounds {
    const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around points.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let extend = |b: Self, p: DVec3| Self { min: b.min.min(p), max: b.max.max(p) };
        points.into_iter().fold(Self::EMPTY, extend)
    }

    fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Twice the middle.
    fn center(&self) -> DVec3 {
        self.min + self.max
    }

    /// Surface area, about, of a box that holds so many items; 0 of none.
    fn cost(&self, items: usize) -> f64 {
        let size = self.max - self.min;
        if items == 0 { 0.0 } else { (size.x * size.y + size.y * size.z + size.z * size.x) * items as f64 }
    }

    fn contains(&self, p: DVec3) -> bool {
        self.min.cmple(p).all() && p.cmple(self.max).all()
    }

    /// Squared distance of a point, 0 inside.
    #[must_use]
    pub fn distance_squared(&self, p: DVec3) -> f64 {
        p.distance_squared(p.clamp(self.min, self.max))
    }

    /// Distance along the ray at which it enters, if before `t_max`.
    fn entry(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let (a, b) = ((self.min - ray.origin) * ray.inverse, (self.max - ray.origin) * ray.inverse);
        // A ray in a face's plane makes 0·∞ = NaN; min and max return the other operand, so the slab does not cut.
        let near = a.min(b).to_array().into_iter().fold(0.0, f64::max);
        let far = a.max(b).to_array().into_iter().fold(t_max, f64::min);
        // The products round: widen, so that no box that is touched is lost (Ize 2013, robust BVH traversal).
        (near <= far * (1.0 + 4.0 * f64::EPSILON)).then_some(near)
    }
}

/// A half line; `direction` is unit, so that distances are metres.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Start.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    inverse: DVec3,
}

impl Ray {
    /// A ray along the unit vector `direction`.
    #[must_use]
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, inverse: direction.recip() }
    }
}

/// The hierarchy; items are numbered as their boxes were.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

/// A leaf holds `count` items from `first`; an inner node (`count` 0) has its children next to it and at `first`.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    first: u32,
    count: u32,
}

const LEAF_SIZE: usize = 4;
/// Levels that choose where to split; below them halves, 32 levels at most, bound a walk's stack.
const CHOICE_DEPTH: usize = 32;
/// Nodes that a walk may have put aside.
const STACK: usize = CHOICE_DEPTH + 32;
/// Slabs of an axis between which a split may lie.
const SLABS: usize = 16;

/// Where items are split: those whose slab along the axis is one of the first.
struct Cut {
    axis: usize,
    low: f64,
    per_slab: f64,
    slabs: usize,
}

impl Cut {
    fn slab(&self, center: DVec3) -> usize {
        (((center[self.axis] - self.low) * self.per_slab) as usize).min(SLABS - 1)
    }

    fn below(&self, center: DVec3) -> bool {
        self.slab(center) < self.slabs
    }

    /// The cut of least surface area times items over both sides, of all axes; `None` where all centres coincide.
    fn best(boxes: &[Bounds], items: &[u32], extent: &Bounds) -> Option<Self> {
        let along = |axis: usize| {
            let low = extent.min[axis];
            let per_slab = SLABS as f64 / (extent.max[axis] - low);
            let cut = Self { axis, low, per_slab, slabs: 0 };
            let mut slabs = [(Bounds::EMPTY, 0); SLABS];
            for &item in items {
                let item = boxes[item as usize];
                let slab = &mut slabs[cut.slab(item.center())];
                *slab = (slab.0.union(item), slab.1 + 1);
            }
            // Costs of the sides above each place, then of those below it.
            let mut above = [0.0; SLABS];
            let mut side = (Bounds::EMPTY, 0);
            for (place, slab) in slabs.iter().enumerate().rev() {
                side = (side.0.union(slab.0), side.1 + slab.1);
                above[place] = side.0.cost(side.1);
            }
            side = (Bounds::EMPTY, 0);
            let mut best = (f64::INFINITY, 0);
            for place in 1..SLABS {
                side = (side.0.union(slabs[place - 1].0), side.1 + slabs[place - 1].1);
                let cost = side.0.cost(side.1) + above[place];
                if side.1 > 0 && side.1 < items.len() && cost < best.0 {
                    best = (cost, place);
                }
            }
            (best.0, Self { slabs: best.1, ..cut })
        };
        let wide = (0..3).filter(|&axis| extent.max[axis] > extent.min[axis]).map(along);
        wide.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(cost, _)| cost.is_finite()).map(|(_, cut)| cut)
    }
}

impl Tree {
    /// Splits where the surface area heuristic says so among a few places of each axis, deep down at the median of the
    /// widest; same boxes, same tree.
    pub(super) fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect() };
        if !boxes.is_empty() {
            tree.split(boxes, 0, boxes.len(), 0);
        }
        tree
    }

    fn split(&mut self, boxes: &[Bounds], first: usize, count: usize, depth: usize) {
        let center = |item: &u32| boxes[*item as usize].center();
        let items = &mut self.items[first..first + count];
        let all = items.iter().map(|&item| boxes[item as usize]);
        let bounds = all.fold(Bounds::EMPTY, Bounds::union);
        let node = self.nodes.len();
        let leaf = count <= LEAF_SIZE;
        self.nodes.push(Node { bounds, first: first as u32, count: if leaf { count as u32 } else { 0 } });
        if leaf {
            return;
        }
        let extent = Bounds::around(items.iter().map(center));
        let cut = if depth < CHOICE_DEPTH { Cut::best(boxes, items, &extent) } else { None };
        let below = match cut {
            Some(cut) => {
                let (low, high): (Vec<u32>, Vec<u32>) =
                    items.iter().partition(|item| cut.below(center(item)));
                items[..low.len()].copy_from_slice(&low);
                items[low.len()..].copy_from_slice(&high);
                low.len()
            }
            None => {
                let axis = (extent.max - extent.min).max_position();
                let order = |a: &u32, b: &u32| center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(b));
                items.select_nth_unstable_by(count / 2, order);
                count / 2
            }
        };
        self.split(boxes, first, below, depth + 1);
        self.nodes[node].first = self.nodes.len() as u32;
        self.split(boxes, first + below, count - below, depth + 1);
    }

    /// Calls `visit` for every item whose box contains the point.
    pub(super) fn at_point(&self, p: DVec3, mut visit: impl FnMut(usize)) {
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let Some(node) = self.nodes.get(index).filter(|node| node.bounds.contains(p)) else {
                continue;
            };
            if node.count == 0 {
                stack.extend([node.first as usize, index + 1]);
            }
            self.leaf(node).iter().for_each(|&item| visit(item as usize));
        }
    }

    /// Calls `visit` for items whose boxes the ray enters before `t_max`; a hit that it returns becomes the new `t_max`.
    pub(super) fn along_ray(
        &self,
        ray: &Ray,
        mut t_max: f64,
        mut visit: impl FnMut(usize, f64) -> Option<f64>,
    ) {
        let entry = |index: usize, t_max| {
            let t = self.nodes.get(index)?.bounds.entry(ray, t_max)?;
            Some((t, index))
        };
        let mut stack = [(0.0, 0); STACK];
        let mut aside = 0;
        if let Some(root) = entry(0, t_max) {
            (stack[0], aside) = (root, 1);
        }
        while aside > 0 {
            aside -= 1;
            let (near, index) = stack[aside];
            if near > t_max {
                continue;
            }
            let node = &self.nodes[index];
            if node.count == 0 {
                let [a, b] = [entry(index + 1, t_max), entry(node.first as usize, t_max)];
                // The nearer child goes on top.
                let a_first = a.map_or(0.0, |a| a.0) < b.map_or(0.0, |b| b.0);
                for child in if a_first { [b, a] } else { [a, b] }.into_iter().flatten() {
                    stack[aside] = child;
                    aside += 1;
                }
            }
            for &item in self.leaf(node) {
                t_max = visit(item as usize, t_max).unwrap_or(t_max);
            }
        }
    }

    /// Whether `hit` says so of any item whose box the ray enters before `t_max`.
    pub(super) fn any_along_ray(&self, ray: &Ray, t_max: f64, mut hit: impl FnMut(usize) -> bool) -> bool {
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let entered = |node: &&Node| node.bounds.entry(ray, t_max).is_some();
            let Some(node) = self.nodes.get(index).filter(entered) else {
                continue;
            };
            if node.count == 0 {
                stack.extend([node.first as usize, index + 1]);
            }
            if self.leaf(node).iter().any(|&item| hit(item as usize)) {
                return true;
            }
        }
        false
    }

    fn leaf(&self, node: &Node) -> &[u32] {
        let first = if node.count == 0 { 0 } else { node.first as usize };
        &self.items[first..first + node.count as usize]
    }
}
