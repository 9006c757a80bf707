//! The tree's shape: binned surface area heuristic (Wald 2007, *On fast Construction of SAH-based Bounding Volume
//! Hierarchies*), with a child's subtrees built side by side where they are large.

use crate::shared::{BVH_LEAF, BvhTriangle};
use glam::Vec3;

/// Bins along each axis.
const BINS: usize = 16;
/// Items from which a node's children are built side by side.
const PARALLEL: usize = 8192;
/// Levels after which items are halved by count: no input makes the tree deeper than this and a logarithm.
const DEEPEST: u32 = 64;
/// Cost of a node's box against that of a triangle.
const BOX_COST: f32 = 0.7;

/// A triangle's box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    lower: Vec3,
    upper: Vec3,
    pub(super) index: u32,
}

impl Item {
    pub(super) fn new(index: u32, triangle: &BvhTriangle) -> Self {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(Vec3::from);
        Self { lower: a.min(b).min(c), upper: a.max(b).max(c), index }
    }

    fn center(&self) -> Vec3 {
        self.lower + self.upper
    }
}

/// A box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) lower: Vec3,
    pub(super) upper: Vec3,
}

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: Bounds,
    /// Next node where this one is missed.
    pub(super) skip: u32,
    /// Leaf: first item and how many; an inner node has none.
    pub(super) items: (u32, u32),
}

impl Bounds {
    const EMPTY: Self = Self { lower: Vec3::INFINITY, upper: Vec3::NEG_INFINITY };

    fn with(self, lower: Vec3, upper: Vec3) -> Self {
        Self { lower: self.lower.min(lower), upper: self.upper.max(upper) }
    }

    fn around(items: &[Item]) -> Self {
        items.iter().fold(Self::EMPTY, |bounds, item| bounds.with(item.lower, item.upper))
    }

    /// Half the surface; 0 of nothing.
    fn area(&self) -> f32 {
        let side = (self.upper - self.lower).max(Vec3::ZERO);
        side.x * side.y + side.y * side.z + side.z * side.x
    }
}

/// Nodes over `items`, which are put into the order of the leaves.
pub(super) fn tree(items: &mut [Item]) -> Vec<Node> {
    if items.is_empty() {
        return Vec::new();
    }
    let mut nodes = subtree(items, 0, 0);
    // Sizes of subtrees become the nodes that follow them.
    for (index, node) in (0..).zip(&mut nodes) {
        node.skip += index;
    }
    nodes
}

/// `skip` of each node is the size of its subtree, so that subtrees need not know where they will lie.
fn subtree(items: &mut [Item], first: usize, depth: u32) -> Vec<Node> {
    let bounds = Bounds::around(items);
    let node = |items, skip| Node { bounds, skip, items };
    let Some(middle) = split(items, &bounds, depth) else {
        return vec![node((first as u32, items.len() as u32), 1)];
    };
    let large = items.len() >= PARALLEL;
    let (left, right) = items.split_at_mut(middle);
    let below = |items: &mut [Item], first: usize| subtree(items, first, depth + 1);
    let (one, other) = if large {
        rayon::join(|| below(left, first), || below(right, first + middle))
    } else {
        (below(left, first), below(right, first + middle))
    };
    // A ray that meets anything is done: the larger box is the likelier to end the walk.
    let (one, other) =
        if other[0].bounds.area() > one[0].bounds.area() { (other, one) } else { (one, other) };
    let mut nodes = vec![node((0, 0), (1 + one.len() + other.len()) as u32)];
    nodes.extend(one);
    nodes.extend(other);
    nodes
}

/// Sorts `items` into two parts and says where the second begins; `None` where a leaf is better.
fn split(items: &mut [Item], bounds: &Bounds, depth: u32) -> Option<usize> {
    let fits = items.len() <= BVH_LEAF as usize;
    let centers = items.iter().fold(Bounds::EMPTY, |all, item| all.with(item.center(), item.center()));
    let binned = (depth < DEEPEST).then(|| cheapest(items, &centers)).flatten();
    match binned {
        Some((cost, ..)) if fits && items.len() as f32 * bounds.area() <= cost + BOX_COST * bounds.area() => {
            None
        }
        Some((_, axis, border)) => {
            let bin = Bin::new(&centers, axis);
            Some(partition(items, |item| bin.of(item) < border))
        }
        None if fits => None,
        // All in one place: by the scene's order.
        None => Some(items.len() / 2),
    }
}

/// Cost, axis and bin of the cheapest border between bins.
fn cheapest(items: &[Item], centers: &Bounds) -> Option<(f32, usize, usize)> {
    let mut best: Option<(f32, usize, usize)> = None;
    for axis in 0..3 {
        if centers.upper[axis] <= centers.lower[axis] {
            continue;
        }
        let bin = Bin::new(centers, axis);
        let mut bins = [(Bounds::EMPTY, 0_u32); BINS];
        for item in items {
            let (bounds, count) = &mut bins[bin.of(item)];
            *bounds = bounds.with(item.lower, item.upper);
            *count += 1;
        }
        let join = |(all, sum): (Bounds, u32), &(bounds, count): &(Bounds, u32)| {
            (all.with(bounds.lower, bounds.upper), sum + count)
        };
        let mut above = [(Bounds::EMPTY, 0); BINS];
        for border in (1..BINS).rev() {
            above[border - 1] = join(above[border], &bins[border]);
        }
        let mut below = (Bounds::EMPTY, 0);
        for border in 1..BINS {
            below = join(below, &bins[border - 1]);
            let other = &above[border - 1];
            let cost = below.0.area() * below.1 as f32 + other.0.area() * other.1 as f32;
            if below.1 > 0 && other.1 > 0 && best.is_none_or(|best| cost < best.0) {
                best = Some((cost, axis, border));
            }
        }
    }
    best
}

/// Which bin of an axis an item lies in.
struct Bin {
    axis: usize,
    lower: f32,
    scale: f32,
}

impl Bin {
    fn new(centers: &Bounds, axis: usize) -> Self {
        let lower = centers.lower[axis];
        Self { axis, lower, scale: BINS as f32 / (centers.upper[axis] - lower) }
    }

    fn of(&self, item: &Item) -> usize {
        (((item.center()[self.axis] - self.lower) * self.scale) as usize).min(BINS - 1)
    }
}

/// Moves the items of which `first` holds to the front; how many there are.
fn partition(items: &mut [Item], first: impl Fn(&Item) -> bool) -> usize {
    let mut count = 0;
    for index in 0..items.len() {
        if first(&items[index]) {
            items.swap(count, index);
            count += 1;
        }
    }
    count
}
