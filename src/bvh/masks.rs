//! Alpha masks beside the tree: there is no bindless, so what a shadow ray must look up lies in one texture.

use crate::scene::{Parameter, Scene, Texels, Texture};
use crate::shared::MaskedTriangle;
use std::collections::BTreeMap;

/// Masks, and the triangles that they cut.
#[derive(Clone, Debug, Default)]
pub(super) struct Masks {
    pub(super) triangles: Vec<MaskedTriangle>,
    /// Whole texels.
    pub(super) words: Vec<u32>,
    /// By texture.
    known: BTreeMap<u32, Mask>,
}

/// Where a mask lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mask {
    words: u32,
    size: u32,
}

impl Masks {
    /// The mask of a material, if it has one that cuts anything.
    pub(super) fn of(&mut self, scene: &Scene, material: u32) -> Option<Mask> {
        let material = scene.materials.get(material as usize)?;
        let index = material.value(Parameter::Mask).texture?;
        let texture = scene.textures.get(index as usize)?;
        let words = &mut self.words;
        let add = || {
            let at = words.len() as u32;
            words.extend(quads(texture));
            words.resize(words.len().next_multiple_of(4), 0);
            Mask { words: at, size: texture.width | texture.height << 16 }
        };
        Some(*self.known.entry(index).or_insert_with(add))
    }

    /// Notes a masked triangle; its number, from 1.
    pub(super) fn cut(&mut self, mask: Mask, [a, b, c]: [[f32; 2]; 3]) -> u32 {
        let uv_ab = [a[0], a[1], b[0], b[1]];
        self.triangles.push(MaskedTriangle { uv_ab, uv_c: c, words: mask.words, size: mask.size });
        self.triangles.len() as u32
    }
}

/// A word for each texel: it and its neighbours to the right, below, and below to the right, from the lowest byte up,
/// so that a bilinear look-up is one fetch.
fn quads(texture: &Texture) -> Vec<u32> {
    let red: Vec<u8> = match &texture.texels {
        Texels::Linear8(texels) => texels.iter().map(|texel| texel[0]).collect(),
        Texels::Srgb8(texels) => texels
            .iter()
            .map(|texel| byte(crate::image::srgb_to_linear(f64::from(texel[0]) / 255.0)))
            .collect(),
        Texels::Float(texels) => texels.iter().map(|texel| byte(f64::from(texel[0]))).collect(),
    };
    let [width, height] = [texture.width, texture.height].map(|side| side as usize);
    let at = |x: usize, y: usize| u32::from(red[y % height * width + x % width]);
    let quad = |i: usize| {
        let (x, y) = (i % width, i / width);
        at(x, y) | at(x + 1, y) << 8 | at(x, y + 1) << 16 | at(x + 1, y + 1) << 24
    };
    (0..red.len()).map(quad).collect()
}

fn byte(value: f64) -> u8 {
    (value * 255.0).round().clamp(0.0, 255.0) as u8
}
