//! Textures of lights, one behind the other in texels: any number of any size behind one binding.
//!
//! A texture begins with a texel for each of its levels: the texel where the level's own begin, counted from the
//! texture's first, and its width and height. Texels are float32 RGB: halves end at 65,504, and light does not.

use crate::scene::mips::Level;

/// Packed textures.
#[derive(Clone, Debug, Default)]
pub(super) struct Heap {
    pub(super) texels: Vec<[u32; 4]>,
}

impl Heap {
    /// Appends a texture; its first texel.
    pub(super) fn push(&mut self, levels: &[Level]) -> u32 {
        let first = self.texels.len();
        let mut begin = levels.len();
        for Level { size, texels } in levels {
            self.texels.push([begin as u32, size[0] as u32, size[1] as u32, 0]);
            begin += texels.len();
        }
        let rgb = |&[r, g, b, _]: &[f32; 4]| [r.to_bits(), g.to_bits(), b.to_bits(), 0];
        levels.iter().for_each(|level| self.texels.extend(level.texels.iter().map(rgb)));
        first as u32
    }
}
