//! The nodes in depth-first orders for nearest hits: a walk without a stack cannot choose which child comes first, so
//! there is an order for each octant of directions.

use super::split::Node;
use crate::shared::HIT_ORDERS;
use rayon::prelude::*;

/// For each octant the nodes in an order where near children come first. Bit i of an octant's number says that
/// directions go down along axis i.
pub(super) fn orders(nodes: &[Node]) -> Vec<Vec<Node>> {
    (0..HIT_ORDERS).into_par_iter().map(|octant| order(nodes, octant)).collect()
}

fn order(nodes: &[Node], octant: u32) -> Vec<Node> {
    let mut ordered = Vec::with_capacity(nodes.len());
    let mut stack: Vec<usize> = (!nodes.is_empty()).then_some(0).into_iter().collect();
    while let Some(index) = stack.pop() {
        let node = nodes[index];
        // Subtrees keep their sizes.
        let skip = (ordered.len() + node.skip as usize - index) as u32;
        ordered.push(Node { skip, ..node });
        if node.items.1 == 0 {
            let (first, second) = (index + 1, nodes[index + 1].skip as usize);
            let swap = nearer(&nodes[second], &nodes[first], octant);
            stack.extend(if swap { [first, second] } else { [second, first] });
        }
    }
    ordered
}

/// Whether rays of the octant come to `a` before they come to `b`: by the axis along which the two are farthest apart.
fn nearer(a: &Node, b: &Node, octant: u32) -> bool {
    let apart = (a.bounds.lower + a.bounds.upper) - (b.bounds.lower + b.bounds.upper);
    let axis = apart.abs().max_position();
    if octant >> axis & 1 == 0 { apart[axis] < 0.0 } else { apart[axis] > 0.0 }
}
