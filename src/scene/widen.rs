//! Pictures of lights whose borders go on, with as many texels as texture coordinates reach beyond 0…1.
//!
//! A light's texture is clamped. Where the device blurs it, it reads smaller copies, of which a border's texel is the mean of
//! many: clamped there, all that lies near the border would go on, a frame of the picture's width. With the border's own
//! texels in the picture every copy is right, and the oracle, which reads the picture itself, sees what it saw.

use super::texture::{Texels, Texture};

/// Texels to add, before and after the picture's, across (by u) and down (by 1 − v).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Margin {
    before: [u32; 2],
    after: [u32; 2],
}

impl Margin {
    /// How far coordinates reach beyond a picture of that size; `None` where they stay within.
    pub(super) fn around(uvs: &[[f32; 2]], size: [u32; 2]) -> Option<Self> {
        let places: Vec<_> = uvs.iter().map(|&uv| down(uv)).collect();
        let beyond = |axis: usize, reach: fn(f64) -> f64| {
            let most = places.iter().map(|place| reach(place[axis])).fold(0.0, f64::max);
            (most * f64::from(size[axis])).ceil() as u32
        };
        let before = [0, 1].map(|axis| beyond(axis, |place| -place));
        let after = [0, 1].map(|axis| beyond(axis, |place| place - 1.0));
        let margin = Self { before, after };
        (before != [0; 2] || after != [0; 2]).then_some(margin)
    }

    /// Sides of a picture of that size with its margin.
    pub(super) fn sides(&self, size: [u32; 2]) -> [u64; 2] {
        [0, 1].map(|axis| [self.before[axis], size[axis], self.after[axis]].map(u64::from).iter().sum())
    }

    /// The picture with its margin, whose sides fit 32 bits.
    pub(super) fn widen(&self, texture: &Texture) -> Texture {
        let size = [texture.width, texture.height];
        let [width, height] = self.sides(size).map(|side| side as u32);
        let texels = match &texture.texels {
            Texels::Srgb8(texels) => Texels::Srgb8(self.filled(texels, size)),
            Texels::Linear8(texels) => Texels::Linear8(self.filled(texels, size)),
            Texels::Float(texels) => Texels::Float(self.filled(texels, size)),
        };
        Texture { name: texture.name.clone(), width, height, texels }
    }

    /// Where the margin leaves coordinates of a picture of that size.
    pub(super) fn moved(&self, uv: [f32; 2], size: [u32; 2]) -> [f32; 2] {
        let (place, sides) = (down(uv), self.sides(size));
        let [u, v] = [0, 1].map(|axis| {
            (place[axis] * f64::from(size[axis]) + f64::from(self.before[axis])) / sides[axis] as f64
        });
        [u as f32, (1.0 - v) as f32]
    }

    fn filled<T: Copy>(&self, texels: &[T], size: [u32; 2]) -> Vec<T> {
        let [columns, rows] = [0, 1].map(|axis| self.sources(axis, size[axis]));
        let row = |y: usize| columns.clone().map(move |x| texels[y * size[0] as usize + x]);
        rows.flat_map(row).collect()
    }

    /// The texel along an axis that each texel is.
    fn sources(&self, axis: usize, side: u32) -> impl Iterator<Item = usize> + Clone {
        let (before, last) = (self.before[axis], side - 1);
        (0..before + side + self.after[axis]).map(move |at| at.saturating_sub(before).min(last) as usize)
    }
}

/// From the upper left.
fn down([u, v]: [f32; 2]) -> [f64; 2] {
    [f64::from(u), 1.0 - f64::from(v)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_go_on() {
        let texels: Vec<_> = (0..6).map(|i| [i as u8; 4]).collect();
        let texture = Texture { name: "t".into(), width: 3, height: 2, texels: Texels::Srgb8(texels) };
        // A column and a half to the left, a row and a bit on top.
        let uvs = [[-0.5, 0.0], [1.0, 1.6]];
        let margin = Margin::around(&uvs, [3, 2]).unwrap();
        assert_eq!(margin, Margin { before: [2, 2], after: [0, 0] });
        let wide = margin.widen(&texture);
        assert_eq!((wide.width, wide.height), (5, 4));
        let Texels::Srgb8(texels) = wide.texels else { panic!("as it was") };
        let rows: Vec<Vec<u8>> =
            texels.chunks(5).map(|row| row.iter().map(|texel| texel[0]).collect()).collect();
        assert_eq!(rows, [[0, 0, 0, 1, 2], [0, 0, 0, 1, 2], [0, 0, 0, 1, 2], [3, 3, 3, 4, 5]]);
        // The same places: texels from the left, and from below.
        assert_eq!(margin.moved([-0.5, 0.0], [3, 2]), [0.1, 0.0]);
        assert_eq!(margin.moved([1.0, 1.0], [3, 2]), [1.0, 0.5]);
    }

    #[test]
    fn coordinates_within_change_nothing() {
        assert_eq!(Margin::around(&[[0.0, 1.0], [1.0, 0.0], [0.3, 0.4]], [64, 64]), None);
        let far = Margin::around(&[[-1e18, 0.0], [1.0, 1e18]], [64, 64]).unwrap();
        assert!(far.sides([64, 64]).iter().all(|side| *side > 1 << 31));
    }
}
