//! Descriptor sets, laid out by the binding tables of [`crate::shared`].

use super::device::Device;
use super::{Buffer, Called, Image, RayTree, Sampler, Use};
use crate::error::Result;
use crate::shared::{Binding, BindingKind, Stages};
use ash::vk;
use bytemuck::Pod;
use std::sync::Arc;

/// Bytes of push constants in every pipeline layout: what Vulkan guarantees.
pub(super) const PUSH_BYTES: u32 = 128;

const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw()
        | vk::ShaderStageFlags::FRAGMENT.as_raw()
        | vk::ShaderStageFlags::COMPUTE.as_raw(),
);

fn stages(stages: Stages) -> vk::ShaderStageFlags {
    match stages {
        Stages::All => STAGES,
        Stages::Fragment => vk::ShaderStageFlags::FRAGMENT,
        Stages::Compute => vk::ShaderStageFlags::COMPUTE,
    }
}

fn kind(kind: BindingKind) -> vk::DescriptorType {
    match kind {
        BindingKind::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
        BindingKind::Storage => vk::DescriptorType::STORAGE_BUFFER,
        BindingKind::Sampled => vk::DescriptorType::SAMPLED_IMAGE,
        BindingKind::Combined => vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
        BindingKind::StorageImage => vk::DescriptorType::STORAGE_IMAGE,
        BindingKind::Input => vk::DescriptorType::INPUT_ATTACHMENT,
        BindingKind::RayTree => vk::DescriptorType::ACCELERATION_STRUCTURE_KHR,
    }
}

/// Rows of a table that a device knows.
fn known(device: &Device, bindings: &'static [Binding]) -> impl Iterator<Item = &'static Binding> {
    let queries = device.has_ray_queries();
    bindings.iter().filter(move |row| queries || row.kind != BindingKind::RayTree)
}

/// Layout of one set.
pub struct SetLayout {
    raw: vk::DescriptorSetLayout,
    bindings: &'static [Binding],
    device: Arc<Device>,
}

impl SetLayout {
    /// The layout of a table of [`crate::shared`].
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, bindings: &'static [Binding]) -> Result<Self> {
        let rows: Vec<_> = known(device, bindings)
            .map(|row| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(row.binding)
                    .descriptor_type(kind(row.kind))
                    .descriptor_count(row.count)
                    .stage_flags(stages(row.stages))
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&rows);
        // SAFETY: binding numbers are unique, as the tests of the shared tables show.
        let raw = unsafe { device.raw.create_descriptor_set_layout(&info, None) }
            .called("vkCreateDescriptorSetLayout")?;
        Ok(Self { raw, bindings, device: device.clone() })
    }
}

impl Drop for SetLayout {
    fn drop(&mut self) {
        // SAFETY: layouts may go before the pipelines made with them.
        unsafe { self.device.raw.destroy_descriptor_set_layout(self.raw, None) };
    }
}

/// Set layouts and push constants of a family of pipelines.
pub struct PipelineLayout {
    pub(super) raw: vk::PipelineLayout,
    sets: Vec<SetLayout>,
    device: Arc<Device>,
}

impl PipelineLayout {
    /// A layout of the given sets, in order, with 128 bytes of push constants.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, sets: &[&'static [Binding]]) -> Result<Self> {
        let sets =
            sets.iter().map(|bindings| SetLayout::new(device, bindings)).collect::<Result<Vec<_>>>()?;
        let raws: Vec<_> = sets.iter().map(|set| set.raw).collect();
        let push = [vk::PushConstantRange { stage_flags: STAGES, offset: 0, size: PUSH_BYTES }];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&raws).push_constant_ranges(&push);
        // SAFETY: at most 4 sets and 128 bytes, as the device's table asks for.
        let raw =
            unsafe { device.raw.create_pipeline_layout(&info, None) }.called("vkCreatePipelineLayout")?;
        Ok(Self { raw, sets, device: device.clone() })
    }

    /// The tables that it was made from, set by set.
    pub(super) fn tables(&self) -> impl Iterator<Item = &'static [Binding]> {
        self.sets.iter().map(|set| set.bindings)
    }

    /// `count` sets of the layout's set number `index`, descriptors unwritten.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn allocate(&self, index: u32, count: u32) -> Result<DescriptorSets> {
        DescriptorSets::new(&self.device, &self.sets[index as usize], count)
    }
}

impl Drop for PipelineLayout {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`.
        unsafe { self.device.raw.destroy_pipeline_layout(self.raw, None) };
    }
}

/// Sets of one layout, and the pool that they live in.
pub struct DescriptorSets {
    pool: vk::DescriptorPool,
    sets: Vec<vk::DescriptorSet>,
    bindings: &'static [Binding],
    device: Arc<Device>,
}

/// One of them, to write or to bind.
#[derive(Clone, Copy)]
pub struct DescriptorSet<'a> {
    pub(super) raw: vk::DescriptorSet,
    owner: &'a DescriptorSets,
}

impl DescriptorSets {
    fn new(device: &Arc<Device>, layout: &SetLayout, count: u32) -> Result<Self> {
        let sizes: Vec<_> = known(device, layout.bindings)
            .map(|row| vk::DescriptorPoolSize {
                ty: kind(row.kind),
                descriptor_count: row.count * count.max(1),
            })
            .collect();
        let info = vk::DescriptorPoolCreateInfo::default().pool_sizes(&sizes).max_sets(count.max(1));
        // SAFETY: sizes are not empty.
        let pool =
            unsafe { device.raw.create_descriptor_pool(&info, None) }.called("vkCreateDescriptorPool")?;
        let mut sets = Self { pool, sets: Vec::new(), bindings: layout.bindings, device: device.clone() };
        if count > 0 {
            let layouts = vec![layout.raw; count as usize];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            // SAFETY: the pool was sized for this many sets.
            sets.sets =
                unsafe { device.raw.allocate_descriptor_sets(&info) }.called("vkAllocateDescriptorSets")?;
        }
        Ok(sets)
    }

    /// Set number `index`.
    #[must_use]
    pub fn get(&self, index: usize) -> DescriptorSet<'_> {
        DescriptorSet { raw: self.sets[index], owner: self }
    }
}

impl Drop for DescriptorSets {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`; the pool takes its sets along.
        unsafe { self.device.raw.destroy_descriptor_pool(self.pool, None) };
    }
}

impl DescriptorSet<'_> {
    fn kind(&self, binding: u32) -> vk::DescriptorType {
        let row = self.owner.bindings.iter().find(|row| row.binding == binding);
        row.map_or(vk::DescriptorType::STORAGE_BUFFER, |row| kind(row.kind))
    }

    fn write(&self, write: vk::WriteDescriptorSet<'_>, binding: u32) {
        let write = write.dst_set(self.raw).dst_binding(binding).descriptor_type(self.kind(binding));
        // SAFETY: the set is not in use while it is written; its resources are kept by whoever binds it.
        unsafe { self.owner.device.raw.update_descriptor_sets(&[write], &[]) };
    }

    /// A whole buffer.
    pub fn buffer<T: Pod>(&self, binding: u32, buffer: &Buffer<T>) {
        let info = [vk::DescriptorBufferInfo { buffer: buffer.raw, offset: 0, range: vk::WHOLE_SIZE }];
        self.write(vk::WriteDescriptorSet::default().buffer_info(&info), binding);
    }

    /// One element of a buffer.
    pub fn element<T: Pod>(&self, binding: u32, buffer: &Buffer<T>, index: usize) {
        let range = size_of::<T>() as vk::DeviceSize;
        let info =
            [vk::DescriptorBufferInfo { buffer: buffer.raw, offset: index as vk::DeviceSize * range, range }];
        self.write(vk::WriteDescriptorSet::default().buffer_info(&info), binding);
    }

    /// An image in the layout of a use.
    pub fn image(&self, binding: u32, image: &Image, used: Use) {
        let info = [vk::DescriptorImageInfo {
            sampler: vk::Sampler::null(),
            image_view: image.view,
            image_layout: used.layout(),
        }];
        self.write(vk::WriteDescriptorSet::default().image_info(&info), binding);
    }

    /// A tree for ray queries.
    pub fn ray_tree(&self, binding: u32, tree: &RayTree) {
        let trees = [tree.top.raw];
        let mut info =
            vk::WriteDescriptorSetAccelerationStructureKHR::default().acceleration_structures(&trees);
        self.write(vk::WriteDescriptorSet::default().descriptor_count(1).push_next(&mut info), binding);
    }

    /// An array of textures under one sampler.
    pub fn textures(&self, binding: u32, images: &[&Image], sampler: &Sampler) {
        let infos: Vec<_> = images
            .iter()
            .map(|image| vk::DescriptorImageInfo {
                sampler: sampler.raw,
                image_view: image.view,
                image_layout: Use::Texture.layout(),
            })
            .collect();
        self.write(vk::WriteDescriptorSet::default().image_info(&infos), binding);
    }
}
