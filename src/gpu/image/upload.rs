//! Texels on their way from the host to an image.

use super::{Image, ImageDescription};
use crate::error::Result;
use crate::gpu::{Buffer, BufferUse, Commands, Device, Format, Use};
use ash::vk;
use bytemuck::Pod;
use std::sync::Arc;

/// Bytes of texels that are staged at a time.
const STAGED: usize = 8 << 20;

impl Image {
    /// A texture of one long row of texels, broken into rows of 2 ^ `width_log2` texels and padded with zeros.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short, or where there are more rows than the device's textures have.
    pub fn of_texels(device: &Arc<Device>, name: &str, width_log2: u32, texels: &[[u32; 4]]) -> Result<Self> {
        let width = 1 << width_log2;
        // Never a power of two of rows: llvmpipe compiles what reads a texture anew where that changes.
        let rows = texels.len().div_ceil(width).max(3);
        let rows = rows + usize::from(rows.is_power_of_two());
        let image = Self::new(
            device,
            &ImageDescription {
                name,
                format: Format::R32G32B32A32_UINT,
                size: [width as u32, rows as u32],
                layers: None,
                mips: 1,
                uses: &[Use::TransferWrite, Use::Texture],
            },
        )?;
        image.replace_texels(texels)?;
        Ok(image)
    }

    /// Other texels for those of [`Image::of_texels`], as many.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn replace_texels(&self, texels: &[[u32; 4]]) -> Result<()> {
        let room = self.size.map(|side| side as usize).iter().product();
        let mut padded = Vec::with_capacity(room);
        padded.extend_from_slice(texels);
        padded.resize(room, [0; 4]);
        self.upload(&[&padded], Use::Texture)
    }

    /// Uploads all mip levels, each level's texels row by row, and leaves the image in use `after`.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn upload<T: Pod>(&self, levels: &[&[T]], after: Use) -> Result<()> {
        let bytes: usize = levels.iter().map(|level| size_of_val(*level)).sum();
        if bytes > STAGED && self.layers == 1 {
            return self.upload_in_pieces(levels, after);
        }
        let texels = levels.iter().map(|level| level.len()).sum();
        let mut staging = Buffer::<T>::new(&self.device, "staging", BufferUse::Upload, texels)?;
        let mut first = 0;
        for level in levels {
            staging.write_from(first, level)?;
            first += level.len();
        }
        self.device.run("upload image", |cmd| {
            cmd.transition(self, Use::Nothing, Use::TransferWrite);
            let mut offset = 0;
            for (mip, level) in (0_u32..).zip(levels) {
                let region = self.region(mip, (self.size[1] >> mip).max(1), offset);
                offset += size_of_val(*level) as u64;
                self.copy_from(cmd, &staging, region);
            }
            cmd.transition(self, Use::TransferWrite, after);
            Ok(())
        })
    }

    /// As [`Image::upload`] of a single layer, some rows at a time: between them others have the device.
    fn upload_in_pieces<T: Pod>(&self, levels: &[&[T]], after: Use) -> Result<()> {
        let mut staging: Option<Buffer<T>> = None;
        self.device.run("upload image", |cmd| {
            cmd.transition(self, Use::Nothing, Use::TransferWrite);
            Ok(())
        })?;
        for (mip, level) in (0_u32..).zip(levels) {
            let height = (self.size[1] >> mip).max(1) as usize;
            let width = level.len() / height;
            let rows = (STAGED / (width * size_of::<T>()).max(1)).clamp(1, height);
            for (piece, first) in level.chunks(rows * width).zip((0..height).step_by(rows)) {
                let staging = match &mut staging {
                    Some(staging) => staging,
                    // The first level's pieces are the largest.
                    none => {
                        none.insert(Buffer::new(&self.device, "staging", BufferUse::Upload, rows * width)?)
                    }
                };
                staging.write_from(0, piece)?;
                let mut region = self.region(mip, (piece.len() / width) as u32, 0);
                region.image_offset.y = first as i32;
                self.device.run("upload image", |cmd| {
                    self.copy_from(cmd, staging, region);
                    Ok(())
                })?;
            }
        }
        self.device.run("upload image", |cmd| {
            cmd.transition(self, Use::TransferWrite, after);
            Ok(())
        })
    }

    /// The image is in use [`Use::TransferWrite`], and the region within both.
    fn copy_from<T: Pod>(&self, cmd: &mut Commands, staging: &Buffer<T>, region: vk::BufferImageCopy) {
        // SAFETY: the staging buffer holds the region's texels, and both are alive until the work has finished.
        unsafe {
            self.device.raw.cmd_copy_buffer_to_image(
                cmd.raw,
                staging.raw,
                self.raw,
                vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                &[region],
            );
        };
    }
}
