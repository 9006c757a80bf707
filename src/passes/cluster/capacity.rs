//! How much room clusters and lists have, and how it grows.

use crate::shared::{
    BLOCK_TILES, Counters, LEAF_LIGHTS, LINEAR_GROUP, LIST_HEIGHT_LOG2, LIST_WIDTH_LOG2, PARENT_ROOM,
    SIBLINGS,
};

/// Array layers that every device has: 2 GiB of lists.
pub(super) const MAX_LAYERS: u32 = 256;

/// Room for clusters, their parents, masks and lists; grows when a frame needs more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Clusters, a multiple of `LINEAR_GROUP`.
    pub clusters: u32,
    /// Parents; 0 where there are no lists.
    pub parents: u32,
    /// Texels of a cluster's mask of area lights.
    pub mask: u32,
    /// Texels of masks and lists.
    pub texels: u32,
    /// Step 10 has lists to make.
    pub folds: bool,
    /// Some of them end in nodes of folded lights.
    pub nodes: bool,
}

impl Capacity {
    /// What a picture of so many tiles starts with: two depth layers, 64 lights in each.
    #[must_use]
    pub fn start(tiles: [u32; 2], lists: bool, mask: u32) -> Self {
        let clusters = (area(tiles).max(32) * 2).next_multiple_of(LINEAR_GROUP);
        let parents = if lists { 4 * area(blocks(tiles)) } else { 0 };
        let room = Self { clusters, parents, mask, texels: 0, folds: false, nodes: false };
        room.with_texels(room.first_texels()[2] + u64::from(area(tiles)) * 32)
    }

    /// Where the lists of parents, the masks of their children and the lists of clusters begin. Masks of area lights come
    /// before them.
    #[must_use]
    pub fn first_texels(self) -> [u64; 3] {
        let parents = u64::from(self.clusters) * u64::from(self.mask);
        let masks = parents + u64::from(self.parents) * u64::from(PARENT_ROOM / 4);
        let siblings = if self.parents > 0 { u64::from(self.clusters / SIBLINGS) } else { 0 };
        [parents, masks, masks + siblings * u64::from(PARENT_ROOM / LEAF_LIGHTS)]
    }

    /// Whole layers of the list image.
    fn with_texels(self, texels: u64) -> Self {
        let layer = 1 << (LIST_WIDTH_LOG2 + LIST_HEIGHT_LOG2);
        // More than fits in 32 bits no device has: the image of the lists says so.
        let layers = texels.div_ceil(u64::from(layer)).clamp(1, u64::from(u32::MAX / layer));
        Self { texels: layers as u32 * layer, ..self }
    }

    /// Enough for what the counters ask for, and a quarter more than there was, so that a camera that comes upon ever more
    /// is not rendered twice each time; `None` if it is enough already.
    #[must_use]
    pub fn grown(self, counters: &Counters) -> Option<Self> {
        let clusters = room(self.clusters, counters.clusters).next_multiple_of(LINEAR_GROUP);
        let parents = if self.parents > 0 { room(self.parents, counters.parents) } else { 0 };
        let folds = self.folds || counters.folding > 0;
        let nodes = self.nodes || counters.overflowed > 0;
        let larger = Self { clusters, parents, folds, nodes, ..self };
        // Where clusters were missing, so were their lists: the texels needed are known only next time.
        let lists = u64::from(room(self.texels, counters.list_texels)) - self.first_texels()[2];
        let larger = larger.with_texels(larger.first_texels()[2] + lists);
        (larger != self).then_some(larger)
    }
}

/// Blocks of tiles, across and down.
pub(super) fn blocks(tiles: [u32; 2]) -> [u32; 2] {
    tiles.map(|side| side.div_ceil(BLOCK_TILES))
}

pub(super) fn area([x, y]: [u32; 2]) -> u32 {
    x * y
}

/// As much as there is, or as needed where that is more: then a quarter more than there is at least.
fn room(has: u32, needed: u32) -> u32 {
    if needed <= has { has } else { needed.max(has.saturating_add(has / 4)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_grows_by_a_quarter_and_only_where_it_is_short() {
        let start = Capacity::start([40, 23], true, 0);
        let [clusters, parents] = [start.clusters, start.parents];
        let counters = Counters { clusters, parents, list_texels: start.texels, ..Counters::default() };
        assert_eq!(start.grown(&counters), None);
        let one_more = start.grown(&Counters { parents: parents + 1, ..counters }).unwrap();
        assert_eq!((one_more.clusters, one_more.parents), (clusters, parents + parents / 4));
        let many = start.grown(&Counters { clusters: 3 * clusters, ..counters }).unwrap();
        assert_eq!((many.clusters, many.parents), (3 * clusters, parents));
        // Lists keep their room behind what comes before them.
        let lists = |room: Capacity| u64::from(room.texels) - room.first_texels()[2];
        let longer = start.grown(&Counters { list_texels: start.texels + 1, ..counters }).unwrap();
        assert!(4 * lists(longer) >= 5 * lists(start) - 3 && longer.clusters == clusters);
        assert!(lists(many) >= lists(start) && lists(one_more) >= lists(start));
    }
}
