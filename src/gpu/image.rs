//! Images with one view each.

mod upload;

use super::device::Device;
use super::{Buffer, BufferUse, Called, Commands, Use, too_large};
use crate::error::Result;
use ash::vk;
use bytemuck::Pod;
use gpu_allocator::vulkan::Allocation;
use std::sync::Arc;

/// What an image is.
#[derive(Clone, Copy, Debug)]
pub struct ImageDescription<'a> {
    /// In captures.
    pub name: &'a str,
    /// Texel format.
    pub format: vk::Format,
    /// Texels across and down.
    pub size: [u32; 2],
    /// Array layers; the view is an array view where this is `Some`.
    pub layers: Option<u32>,
    /// Mip levels.
    pub mips: u32,
    /// Every use it will have.
    pub uses: &'a [Use],
}

/// An image and its view over everything in it.
pub struct Image {
    pub(super) raw: vk::Image,
    pub(super) view: vk::ImageView,
    pub(super) size: [u32; 2],
    format: vk::Format,
    layers: u32,
    mips: u32,
    allocation: Option<Allocation>,
    device: Arc<Device>,
}

impl Image {
    /// Makes an image; its contents are undefined.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, description: &ImageDescription<'_>) -> Result<Self> {
        let &ImageDescription { name, format, size, layers, mips, uses } = description;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 })
            .mip_levels(mips)
            .array_layers(layers.unwrap_or(1))
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(uses.iter().fold(vk::ImageUsageFlags::empty(), |flags, &used| flags | usage(used)));
        require_room(device, name, &info)?;
        // SAFETY: the format was checked against the device's table, the size just now.
        let raw = unsafe { device.raw.create_image(&info, None) }.called("vkCreateImage")?;
        let mut image = Self {
            raw,
            view: vk::ImageView::null(),
            size,
            format,
            layers: layers.unwrap_or(1),
            mips,
            allocation: None,
            device: device.clone(),
        };
        image.allocation = Some(device.allocate_for_image(name, raw)?);
        let kind =
            if layers.is_some() { vk::ImageViewType::TYPE_2D_ARRAY } else { vk::ImageViewType::TYPE_2D };
        let view = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(kind)
            .format(format)
            .subresource_range(image.everything());
        // SAFETY: the view covers the image it is made of.
        image.view = unsafe { device.raw.create_image_view(&view, None) }.called("vkCreateImageView")?;
        device.name(raw, name);
        device.name(image.view, name);
        Ok(image)
    }

    /// Texels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    fn aspect(&self) -> vk::ImageAspectFlags {
        if self.format == vk::Format::D32_SFLOAT {
            vk::ImageAspectFlags::DEPTH
        } else {
            vk::ImageAspectFlags::COLOR
        }
    }

    fn everything(&self) -> vk::ImageSubresourceRange {
        vk::ImageSubresourceRange {
            aspect_mask: self.aspect(),
            base_mip_level: 0,
            level_count: self.mips,
            base_array_layer: 0,
            layer_count: self.layers,
        }
    }

    /// Copies whole layers of the top mip level, which lie one after the other in `texels`, to layers `first`, `first` + 2
    /// and so on, from use `before` to use `after`; the others keep what they hold unless `before` is [`Use::Nothing`].
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn upload_every_other<T: Pod>(
        &self,
        texels: &Buffer<T>,
        first: u32,
        before: Use,
        after: Use,
    ) -> Result<()> {
        let bytes = u64::from(self.size[0]) * u64::from(self.size[1]) * size_of::<T>() as u64;
        let layers = (first..self.layers).step_by(2);
        let regions: Vec<_> = (0..)
            .zip(layers)
            .map(|(place, layer)| {
                let mut region = self.region(0, self.size[1], place * bytes);
                region.image_subresource.base_array_layer = layer;
                region.image_subresource.layer_count = 1;
                region
            })
            .collect();
        self.device.run("upload layers", |cmd| {
            cmd.transition(self, before, Use::TransferWrite);
            // SAFETY: the buffer holds half the image's layers, and both are alive until the work has finished.
            unsafe {
                self.device.raw.cmd_copy_buffer_to_image(
                    cmd.raw,
                    texels.raw,
                    self.raw,
                    vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                    &regions,
                );
            };
            cmd.transition(self, Use::TransferWrite, after);
            Ok(())
        })
    }

    fn region(&self, mip: u32, rows: u32, buffer_offset: u64) -> vk::BufferImageCopy {
        vk::BufferImageCopy {
            buffer_offset,
            image_subresource: vk::ImageSubresourceLayers {
                aspect_mask: self.aspect(),
                mip_level: mip,
                base_array_layer: 0,
                layer_count: self.layers,
            },
            image_extent: vk::Extent3D { width: (self.size[0] >> mip).max(1), height: rows, depth: 1 },
            ..vk::BufferImageCopy::default()
        }
    }

    /// Copies the top mip level of all layers to the host, from use `before`, and back to use `after`.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn fetch<T: Pod>(&self, before: Use, after: Use) -> Result<Vec<T>> {
        let texels = self.size[0] as usize * self.size[1] as usize * self.layers as usize;
        self.fetch_region(self.region(0, self.size[1], 0), texels, before, after)
    }

    /// As [`Image::fetch`], one texel of the first layer.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn fetch_texel<T: Pod>(&self, at: [u32; 2], before: Use, after: Use) -> Result<T> {
        let [x, y] = [0, 1].map(|axis| at[axis].min(self.size[axis] - 1) as i32);
        let mut region = self.region(0, 1, 0);
        region.image_offset = vk::Offset3D { x, y, z: 0 };
        region.image_extent.width = 1;
        region.image_subresource.layer_count = 1;
        self.fetch_region(region, 1, before, after).map(|texels| texels[0])
    }

    fn fetch_region<T: Pod>(
        &self,
        region: vk::BufferImageCopy,
        texels: usize,
        before: Use,
        after: Use,
    ) -> Result<Vec<T>> {
        let staging = Buffer::<T>::new(&self.device, "readback", BufferUse::Readback, texels)?;
        self.device.run("read image", |cmd| {
            cmd.transition(self, before, Use::TransferRead);
            // SAFETY: the staging buffer holds every texel of the region; `T` is as large as the format's texel.
            unsafe {
                self.device.raw.cmd_copy_image_to_buffer(
                    cmd.raw,
                    self.raw,
                    vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                    staging.raw,
                    &[region],
                );
            };
            cmd.memory_barrier(Use::TransferWrite, Use::HostRead);
            cmd.transition(self, Use::TransferRead, after);
            Ok(())
        })?;
        staging.read()
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`; the view goes before its image.
        unsafe { self.device.raw.destroy_image_view(self.view, None) };
        // SAFETY: as above.
        unsafe { self.device.raw.destroy_image(self.raw, None) };
        if let Some(allocation) = self.allocation.take() {
            self.device.memory.free(allocation);
        }
    }
}

fn require_room(device: &Device, name: &str, info: &vk::ImageCreateInfo<'_>) -> Result<()> {
    let most = device.image_limits(info)?;
    let vk::Extent3D { width, height, .. } = info.extent;
    if width <= most.max_extent.width
        && height <= most.max_extent.height
        && info.mip_levels <= most.max_mip_levels
        && info.array_layers <= most.max_array_layers
    {
        return Ok(());
    }
    let shape = |width, height, layers| format!("{width} × {height} texels in {layers} layers");
    Err(too_large(
        &format!("image {name}"),
        &shape(width, height, info.array_layers),
        &shape(most.max_extent.width, most.max_extent.height, most.max_array_layers),
    ))
}

fn usage(used: Use) -> vk::ImageUsageFlags {
    match used {
        Use::Nothing | Use::HostRead | Use::IndirectRead | Use::RayTree | Use::Acquired | Use::Present => {
            vk::ImageUsageFlags::empty()
        }
        Use::TransferWrite => vk::ImageUsageFlags::TRANSFER_DST,
        Use::TransferRead => vk::ImageUsageFlags::TRANSFER_SRC,
        Use::ComputeWrite | Use::StorageRead => vk::ImageUsageFlags::STORAGE,
        Use::ComputeRead | Use::FragmentRead | Use::Texture => vk::ImageUsageFlags::SAMPLED,
        Use::DepthWrite | Use::DepthTest => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
        Use::DepthRead => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
        Use::ColorWrite => vk::ImageUsageFlags::COLOR_ATTACHMENT,
        Use::InputRead => vk::ImageUsageFlags::INPUT_ATTACHMENT,
    }
}

impl Commands {
    /// Moves an image from one use to the next; from [`Use::Nothing`] its contents are lost.
    pub fn transition(&mut self, image: &Image, before: Use, after: Use) {
        self.transition_raw((image.raw, image.everything()), before, after);
    }

    /// Copies the pixels of columns `columns` between two images of one size and format, in uses [`Use::TransferRead`] and
    /// [`Use::TransferWrite`].
    pub fn copy_columns(&mut self, from: &Image, to: &Image, columns: std::ops::Range<u32>) {
        if columns.is_empty() {
            return;
        }
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let offset = vk::Offset3D { x: columns.start as i32, y: 0, z: 0 };
        let region = vk::ImageCopy {
            src_subresource: layers,
            src_offset: offset,
            dst_subresource: layers,
            dst_offset: offset,
            extent: vk::Extent3D { width: columns.end - columns.start, height: from.size[1], depth: 1 },
        };
        let [before, after] = [Use::TransferRead, Use::TransferWrite].map(Use::layout);
        // SAFETY: both images are alive and in these layouts, and have the columns.
        unsafe { self.device.raw.cmd_copy_image(self.raw, from.raw, before, to.raw, after, &[region]) };
    }

    /// Clears a colour image, in use [`Use::TransferWrite`], to 0.
    pub fn clear(&mut self, image: &Image) {
        let layout = Use::TransferWrite.layout();
        let zero = vk::ClearColorValue::default();
        // SAFETY: the image is alive, of colour, and in that layout.
        unsafe {
            self.device.raw.cmd_clear_color_image(self.raw, image.raw, layout, &zero, &[image.everything()]);
        };
    }

    pub(super) fn transition_raw(
        &mut self,
        (image, range): (vk::Image, vk::ImageSubresourceRange),
        before: Use,
        after: Use,
    ) {
        let (src_stage, src_access, old) = before.scope();
        let (dst_stage, dst_access, new) = after.scope();
        let barrier = vk::ImageMemoryBarrier::default()
            .src_access_mask(src_access)
            .dst_access_mask(dst_access)
            .old_layout(old)
            .new_layout(new)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(image)
            .subresource_range(range);
        // SAFETY: the image is alive; layouts come from the table of uses.
        unsafe {
            self.device.raw.cmd_pipeline_barrier(
                self.raw,
                src_stage,
                dst_stage,
                vk::DependencyFlags::empty(),
                &[],
                &[],
                &[barrier],
            );
        };
    }
}
