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

impl Tree {
    /// Splits at the median of the widest axis; same boxes, same tree.
    pub(super) fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect() };
        if !boxes.is_empty() {
            tree.split(boxes, 0, boxes.len());
        }
        tree
    }

    fn split(&mut self, boxes: &[Bounds], first: usize, count: usize) {
        let center = |item: &u32| boxes[*item as usize].min + boxes[*item as usize].max;
        let items = &mut self.items[first..first + count];
        let all = items.iter().map(|&item| boxes[item as usize]);
        let bounds = all.fold(Bounds::EMPTY, Bounds::union);
        let extent = Bounds::around(items.iter().map(center));
        let axis = (extent.max - extent.min).max_position();
        let node = self.nodes.len();
        let leaf = count <= LEAF_SIZE;
        self.nodes.push(Node { bounds, first: first as u32, count: if leaf { count as u32 } else { 0 } });
        if leaf {
            return;
        }
        items.select_nth_unstable_by(count / 2, |a, b| {
            center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(b))
        });
        self.split(boxes, first, count / 2);
        self.nodes[node].first = self.nodes.len() as u32;
        self.split(boxes, first + count / 2, count - count / 2);
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
        let mut stack: Vec<_> = entry(0, t_max).into_iter().collect();
        while let Some((near, index)) = stack.pop() {
            if near > t_max {
                continue;
            }
            let node = &self.nodes[index];
            if node.count == 0 {
                let mut children = [entry(index + 1, t_max), entry(node.first as usize, t_max)];
                // The nearer child goes on top.
                children.sort_by(|a, b| b.map_or(0.0, |c| c.0).total_cmp(&a.map_or(0.0, |c| c.0)));
                stack.extend(children.into_iter().flatten());
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
