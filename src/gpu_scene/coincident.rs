//! Triangles that lie exactly on others: light is added where depths are equal, so each place may be drawn once.

use foldhash::fast::RandomState;
use std::collections::HashMap;

type Bits = [u32; 3];

/// Places of triangles drawn so far, and the sides from which they are seen.
#[derive(Default)]
pub(super) struct Drawn(HashMap<[Bits; 3], [bool; 2], RandomState>);

impl Drawn {
    /// Notes a triangle; false if one on the same place is already seen from the same side.
    pub(super) fn insert(&mut self, corners: [[f32; 3]; 3], both_sides: bool) -> bool {
        // Adding 0 makes −0 and 0 one place.
        let bits = corners.map(|corner| corner.map(|v| (v + 0.0).to_bits()));
        let first = (0..3).min_by_key(|&i| bits[i]).unwrap_or(0);
        let (a, b, c) = (bits[first], bits[(first + 1) % 3], bits[(first + 2) % 3]);
        let front = b < c;
        let seen_from = [both_sides || front, both_sides || !front];
        let drawn = self.0.entry([a, b.min(c), b.max(c)]).or_default();
        let hidden = (0..2).any(|side| drawn[side] && seen_from[side]);
        if !hidden {
            (0..2).for_each(|side| drawn[side] |= seen_from[side]);
        }
        !hidden
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_place_is_seen_once_from_each_side() {
        let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, -0.0], [0.0, 1.0, 0.0]];
        let mut drawn = Drawn::default();
        assert!(drawn.insert([a, b, c], false));
        assert!(!drawn.insert([b, c, a], false), "the same winding");
        assert!(drawn.insert([a, c, b], false), "the other side");
        assert!(!drawn.insert([c, b, a], true));
        assert!(drawn.insert([a, b, [0.0, 1.0, 1.0]], true));
    }
}
