//! Textures of materials in one heap: there is no bindless, and a ray may meet any of them.
//!
//! A texel holds four halves of the texture's and four of its right neighbour's, so that a bilinear look-up is two
//! fetches: 16 bytes, or 4 MiB of a texture at the size to which larger ones are reduced. Indirect light is a mean over
//! many texels, and each level keeps the mean of the one above.

use super::materials::READ;
use crate::bvh::Texel;
use crate::scene::Scene;
use crate::scene::mips::{Level, levels};
use half::f16;
use rayon::prelude::*;

/// Texels along a side at most.
const MOST: usize = 512;

/// Where each texture of the scene lies.
pub(super) struct Heap(Vec<Option<Place>>);

/// A texture in the heap.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) first: u32,
    pub(super) size: [u32; 2],
}

impl Heap {
    /// Appends the textures that a hit may read.
    pub(super) fn append(scene: &Scene, texels: &mut Vec<Texel>) -> Self {
        let used = |index: usize| {
            let materials = scene.materials.iter();
            let mut values = materials.flat_map(|material| &material.parameters[..READ]);
            values.any(|value| value.texture == Some(index as u32))
        };
        let reduced: Vec<_> = scene
            .textures
            .par_iter()
            .enumerate()
            .map(|(index, texture)| {
                let fits = |level: &Level| level.size.iter().all(|&side| side <= MOST);
                let level = used(index).then(|| levels(texture).into_iter().find(fits)).flatten();
                level.map(|level| (level.size.map(|side| side as u32), pairs(&level)))
            })
            .collect();
        let mut place = |(size, pairs): (_, Vec<Texel>)| {
            let first = texels.len() as u32;
            texels.extend(pairs);
            Place { first, size }
        };
        Self(reduced.into_iter().map(|texture| texture.map(&mut place)).collect())
    }

    pub(super) fn place(&self, texture: u32) -> Option<Place> {
        *self.0.get(texture as usize)?
    }
}

fn pairs(level: &Level) -> Vec<Texel> {
    let [width, _] = level.size;
    let row = |row: &[[f32; 4]]| -> Vec<Texel> {
        let packed: Vec<_> = row.iter().map(|&texel| halves(texel)).collect();
        (0..width)
            .map(|x| (packed[x], packed[(x + 1) % width]))
            .map(|([a, b], [c, d])| [a, b, c, d])
            .collect()
    };
    level.texels.chunks_exact(width).flat_map(row).collect()
}

/// Beyond a half's range a texel would become infinite.
fn halves(texel: [f32; 4]) -> [u32; 2] {
    let most = f16::MAX.to_f32();
    let [r, g, b, a] = texel.map(|v| u32::from(f16::from_f32(v.clamp(-most, most)).to_bits()));
    [r | g << 16, b | a << 16]
}
