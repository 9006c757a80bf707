//! Textures on the device, with mip chains made in linear light.

use crate::error::Result;
use crate::gpu::{DescriptorSets, Device, Format, Image, ImageDescription, PipelineLayout, Sampler, Use};
use crate::scene::{Scene, Texels, Texture};
use crate::shared;
use half::f16;
use std::sync::Arc;

/// A scene's textures, the white texel of unused slots, and the sampler.
pub(super) struct Textures {
    images: Vec<Image>,
    white: Image,
    sampler: Sampler,
}

impl Textures {
    pub(super) fn new(device: &Arc<Device>, scene: &Scene) -> Result<Self> {
        let white =
            Texture { name: "white".into(), width: 1, height: 1, texels: Texels::Linear8(vec![[255; 4]]) };
        Ok(Self {
            images: scene.textures.iter().map(|texture| upload(device, texture)).collect::<Result<_>>()?,
            white: upload(device, &white)?,
            sampler: Sampler::new(device)?,
        })
    }

    /// One set per material, its textures in the order of its parameters.
    pub(super) fn bind(&self, layout: &PipelineLayout, scene: &Scene) -> Result<DescriptorSets> {
        let sets = layout.allocate(shared::material::SET, scene.materials.len() as u32)?;
        for (index, material) in scene.materials.iter().enumerate() {
            let mut slots: Vec<&Image> = material
                .parameters
                .iter()
                .filter_map(|value| value.texture)
                .map(|i| &self.images[i as usize])
                .collect();
            slots.resize(shared::MATERIAL_TEXTURES as usize, &self.white);
            sets.get(index).textures(shared::material::MATERIAL_SLOTS, &slots, &self.sampler);
        }
        Ok(sets)
    }
}

fn upload(device: &Arc<Device>, texture: &Texture) -> Result<Image> {
    let size = [texture.width, texture.height];
    let mips = u32::BITS - size[0].max(size[1]).leading_zeros();
    let format = match texture.texels {
        // lavapipe 22.3.6 filters 8-bit texels in 8 bits: mean error of a textured wall 3.5e-3, in halves 1.3e-4.
        _ if device.is_cpu() => Format::R16G16B16A16_SFLOAT,
        Texels::Srgb8(_) => Format::R8G8B8A8_SRGB,
        Texels::Linear8(_) => Format::R8G8B8A8_UNORM,
        Texels::Float(_) => Format::R16G16B16A16_SFLOAT,
    };
    let uses = &[Use::TransferWrite, Use::Texture];
    let image = Image::new(
        device,
        &ImageDescription { name: &texture.name, format, size, layers: None, mips, uses },
    )?;
    let levels = mip_chain(linear(&texture.texels), size, mips);
    match format {
        Format::R8G8B8A8_SRGB => {
            upload_levels(&image, &levels, |[r, g, b, a]| [encode(r), encode(g), encode(b), quantise(a)])?
        }
        Format::R8G8B8A8_UNORM => upload_levels(&image, &levels, |texel| texel.map(quantise))?,
        // Beyond half's range a texel would become infinite.
        _ => {
            let most = f16::MAX.to_f32();
            upload_levels(&image, &levels, |texel| texel.map(|v| f16::from_f32(v.clamp(-most, most))))?;
        }
    }
    Ok(image)
}

fn upload_levels<T: bytemuck::Pod>(
    image: &Image,
    levels: &[Vec<[f32; 4]>],
    encode: impl Fn([f32; 4]) -> T,
) -> Result<()> {
    let encoded: Vec<Vec<T>> =
        levels.iter().map(|level| level.iter().map(|&texel| encode(texel)).collect()).collect();
    let slices: Vec<&[T]> = encoded.iter().map(Vec::as_slice).collect();
    image.upload(&slices, Use::Texture)
}

fn linear(texels: &Texels) -> Vec<[f32; 4]> {
    let unit = |byte: u8| f32::from(byte) / 255.0;
    match texels {
        Texels::Srgb8(texels) => texels
            .iter()
            .map(|&[r, g, b, a]| [decode(unit(r)), decode(unit(g)), decode(unit(b)), unit(a)])
            .collect(),
        Texels::Linear8(texels) => texels.iter().map(|texel| texel.map(unit)).collect(),
        Texels::Float(texels) => texels.clone(),
    }
}

/// Each level is the area average of the one above: 2 × 2 texels, or up to 3 weighted ones along an odd side.
fn mip_chain(top: Vec<[f32; 4]>, size: [u32; 2], mips: u32) -> Vec<Vec<[f32; 4]>> {
    let mut levels = vec![top];
    let mut from = size.map(|side| side as usize);
    for _ in 1..mips {
        let to = from.map(|side| (side / 2).max(1));
        let above = &levels[levels.len() - 1];
        let columns: Vec<_> = (0..to[0]).map(|x| footprint(x, from[0], to[0])).collect();
        let level = (0..to[1])
            .flat_map(|y| {
                let rows = footprint(y, from[1], to[1]);
                columns.iter().map(move |columns| average(above, from[0], columns, &rows))
            })
            .collect();
        levels.push(level);
        from = to;
    }
    levels
}

/// Texels of a side of `from` that texel `index` of a side of `to` covers, with weights that sum to 1.
fn footprint(index: usize, from: usize, to: usize) -> Vec<(usize, f32)> {
    let scale = from as f32 / to as f32;
    let (begin, end) = (index as f32 * scale, (index + 1) as f32 * scale);
    (begin as usize..from)
        .map(|texel| (texel, (end.min((texel + 1) as f32) - begin.max(texel as f32)) / scale))
        .take_while(|&(_, weight)| weight > 1e-5)
        .collect()
}

fn average(texels: &[[f32; 4]], width: usize, columns: &[(usize, f32)], rows: &[(usize, f32)]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for &(y, wy) in rows {
        for &(x, wx) in columns {
            let texel = texels[y * width + x];
            (0..4).for_each(|c| sum[c] += wx * wy * texel[c]);
        }
    }
    sum
}

fn decode(v: f32) -> f32 {
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

fn encode(v: f32) -> u8 {
    quantise(if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 })
}

fn quantise(v: f32) -> u8 {
    (v * 255.0).round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_keeps_the_mean_and_the_encoding_survives() {
        let top: Vec<[f32; 4]> = (0..64).map(|i| [i as f32 / 63.0; 4]).collect();
        let levels = mip_chain(top, [8, 8], 4);
        assert_eq!(levels.iter().map(Vec::len).collect::<Vec<_>>(), [64, 16, 4, 1]);
        assert!((levels[3][0][0] - 0.5).abs() < 1e-6);
        assert!((0..=255_u8).all(|byte| encode(decode(f32::from(byte) / 255.0)) == byte));
    }

    #[test]
    fn odd_and_thin_images_shrink_to_one_texel() {
        let top: Vec<[f32; 4]> = (0..15).map(|i| [(i % 5) as f32; 4]).collect();
        let levels = mip_chain(top, [5, 3], 3);
        assert_eq!(levels.iter().map(Vec::len).collect::<Vec<_>>(), [15, 2, 1]);
        // Columns 0, 1 and half of 2, over two and a half; the whole keeps the mean.
        assert!((levels[1][0][0] - 0.8).abs() < 1e-6);
        assert!((levels[2][0][0] - 2.0).abs() < 1e-6);
    }
}
