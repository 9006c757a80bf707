//! Textures on the device.

use crate::error::Result;
use crate::gpu::{DescriptorSets, Device, Format, Image, ImageDescription, PipelineLayout, Sampler, Use};
use crate::scene::mips::{Level, levels};
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
    let levels = levels(texture);
    let mips = levels.len() as u32;
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
    levels: &[Level],
    encode: impl Fn([f32; 4]) -> T,
) -> Result<()> {
    let encoded: Vec<Vec<T>> =
        levels.iter().map(|level| level.texels.iter().map(|&texel| encode(texel)).collect()).collect();
    let slices: Vec<&[T]> = encoded.iter().map(Vec::as_slice).collect();
    image.upload(&slices, Use::Texture)
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
    use crate::scene::mips::decode;

    #[test]
    fn the_encoding_survives() {
        assert!((0..=255_u8).all(|byte| encode(decode(f32::from(byte) / 255.0)) == byte));
    }
}
