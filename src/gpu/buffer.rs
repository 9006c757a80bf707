//! Typed buffers.

use super::device::Device;
use super::{Called, Commands, Use, too_large};
use crate::error::{Error, Result};
use ash::vk;
use bytemuck::Pod;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;
use std::marker::PhantomData;
use std::sync::Arc;

/// What a buffer is for; every buffer may be copied from and to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BufferUse {
    /// `uniform` block, written by the host.
    Uniform,
    /// `buffer` block, also dispatch arguments.
    Storage,
    /// Vertices.
    Vertex,
    /// Indices.
    Index,
    /// Vertices or indices that the host writes for every picture.
    Stream,
    /// What a [`RayTree`](super::RayTree) is built from.
    RayTreeInput,
    /// A [`RayTree`](super::RayTree).
    RayTree,
    /// What building one needs meanwhile.
    RayTreeScratch,
    /// Staging towards the device.
    Upload,
    /// Staging towards the host.
    Readback,
}

impl BufferUse {
    fn flags(self) -> vk::BufferUsageFlags {
        let both = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
        both | match self {
            Self::Uniform => vk::BufferUsageFlags::UNIFORM_BUFFER,
            Self::Storage => vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::INDIRECT_BUFFER,
            Self::Vertex => vk::BufferUsageFlags::VERTEX_BUFFER,
            Self::Index => vk::BufferUsageFlags::INDEX_BUFFER,
            Self::Stream => vk::BufferUsageFlags::VERTEX_BUFFER | vk::BufferUsageFlags::INDEX_BUFFER,
            Self::RayTreeInput => {
                vk::BufferUsageFlags::ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_KHR
                    | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS
            }
            Self::RayTree => {
                vk::BufferUsageFlags::ACCELERATION_STRUCTURE_STORAGE_KHR
                    | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS
            }
            Self::RayTreeScratch => {
                vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS
            }
            Self::Upload | Self::Readback => vk::BufferUsageFlags::empty(),
        }
    }

    fn location(self) -> MemoryLocation {
        match self {
            Self::Uniform | Self::Stream | Self::Upload => MemoryLocation::CpuToGpu,
            Self::Readback => MemoryLocation::GpuToCpu,
            Self::Storage
            | Self::Vertex
            | Self::Index
            | Self::RayTreeInput
            | Self::RayTree
            | Self::RayTreeScratch => MemoryLocation::GpuOnly,
        }
    }
}

/// `len` elements of `T` in device memory.
pub struct Buffer<T> {
    pub(super) raw: vk::Buffer,
    len: usize,
    name: String,
    // `None` only while dropping.
    allocation: Option<Allocation>,
    device: Arc<Device>,
    element: PhantomData<T>,
}

impl<T: Pod> Buffer<T> {
    /// Allocates `len` elements, at least one; their contents are undefined.
    ///
    /// # Errors
    /// [`Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, name: &str, usage: BufferUse, len: usize) -> Result<Self> {
        let bytes = (len.max(1) * size_of::<T>()) as vk::DeviceSize;
        let most = vk::DeviceSize::from(device.limits.max_storage_buffer_range);
        if usage == BufferUse::Storage && bytes > most {
            return Err(too_large(
                &format!("buffer {name}"),
                &format!("{bytes} bytes"),
                &format!("{most} bytes"),
            ));
        }
        let info = vk::BufferCreateInfo::default().size(bytes).usage(usage.flags());
        // SAFETY: the size is not 0, and the usage fits the device by Vulkan's guarantees.
        let raw = unsafe { device.raw.create_buffer(&info, None) }.called("vkCreateBuffer")?;
        let mut buffer = Self {
            raw,
            len,
            name: name.into(),
            allocation: None,
            device: device.clone(),
            element: PhantomData,
        };
        buffer.allocation = Some(device.allocate_for_buffer(name, raw, usage.location())?);
        device.name(raw, name);
        Ok(buffer)
    }

    /// A device-local buffer with the given contents; waits for the copy.
    ///
    /// # Errors
    /// As [`Buffer::new`].
    pub fn with(device: &Arc<Device>, name: &str, usage: BufferUse, data: &[T]) -> Result<Self> {
        let buffer = Self::new(device, name, usage, data.len())?;
        if !data.is_empty() {
            let mut staging = Self::new(device, "staging", BufferUse::Upload, data.len())?;
            staging.write(data)?;
            device.run(&format!("upload {name}"), |cmd| {
                cmd.copy_buffer(&staging, &buffer);
                Ok(())
            })?;
        }
        Ok(buffer)
    }

    /// Elements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no element.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Copies `data` to the front of a host-visible buffer.
    ///
    /// # Errors
    /// As [`Buffer::write_from`].
    pub fn write(&mut self, data: &[T]) -> Result<()> {
        self.write_from(0, data)
    }

    /// Copies `data` into a host-visible buffer, from its element `first` on.
    ///
    /// # Errors
    /// [`Error::Vulkan`] where the buffer is not host-visible or too short: a bug in amas.
    pub fn write_from(&mut self, first: usize, data: &[T]) -> Result<()> {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let first = first * size_of::<T>();
        let mapped = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        match mapped.and_then(|mapped| mapped.get_mut(first..first + bytes.len())) {
            Some(target) => {
                target.copy_from_slice(bytes);
                Ok(())
            }
            None => Err(self.not_mapped()),
        }
    }

    /// A host-visible buffer's memory, to be written; reading it may be slow.
    ///
    /// # Errors
    /// As [`Buffer::write`].
    pub fn mapped(&mut self) -> Result<&mut [T]> {
        let bytes = self.len * size_of::<T>();
        if self.allocation.as_ref().and_then(Allocation::mapped_slice).is_none() {
            return Err(self.not_mapped());
        }
        let error = self.not_mapped();
        let mapped = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        let mapped = mapped.and_then(|mapped| mapped.get_mut(..bytes));
        // Vulkan promises no alignment of staging memory for every type.
        mapped.and_then(|mapped| bytemuck::try_cast_slice_mut(mapped).ok()).ok_or(error)
    }

    /// Copies a host-visible buffer's contents out; the device must have finished writing.
    ///
    /// # Errors
    /// As [`Buffer::write`].
    pub fn read(&self) -> Result<Vec<T>> {
        let mapped = self.allocation.as_ref().and_then(Allocation::mapped_slice);
        mapped
            .and_then(|mapped| mapped.get(..self.len * size_of::<T>()))
            .map(bytemuck::pod_collect_to_vec)
            .ok_or_else(|| self.not_mapped())
    }

    /// Copies a device-local buffer to the host; waits.
    ///
    /// # Errors
    /// [`Error::Vulkan`] from the driver.
    pub fn fetch(&self, before: Use) -> Result<Vec<T>> {
        let staging = Self::new(&self.device, "readback", BufferUse::Readback, self.len)?;
        self.device.run(&format!("read {}", self.name), |cmd| {
            cmd.memory_barrier(before, Use::TransferRead);
            cmd.copy_buffer(self, &staging);
            cmd.memory_barrier(Use::TransferWrite, Use::HostRead);
            Ok(())
        })?;
        staging.read()
    }

    /// Where it lies, as shaders and drivers count; the device has ray queries.
    pub(super) fn address(&self) -> vk::DeviceAddress {
        let info = vk::BufferDeviceAddressInfo::default().buffer(self.raw);
        // SAFETY: the buffer was made to have an address, and the feature is on where ray trees are made.
        unsafe { self.device.raw.get_buffer_device_address(&info) }
    }

    fn not_mapped(&self) -> Error {
        Error::Vulkan {
            call: format!("access to buffer {}", self.name),
            result: "not mapped, too short, or not aligned".into(),
            remedy: "report this".into(),
        }
    }
}

impl<T> Drop for Buffer<T> {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`, which borrows what it uses.
        unsafe { self.device.raw.destroy_buffer(self.raw, None) };
        if let Some(allocation) = self.allocation.take() {
            self.device.memory.free(allocation);
        }
    }
}

impl Commands {
    /// Copies a whole buffer to the front of another.
    pub fn copy_buffer<T: Pod>(&mut self, from: &Buffer<T>, to: &Buffer<T>) {
        let bytes = (from.len.min(to.len) * size_of::<T>()) as vk::DeviceSize;
        if bytes == 0 {
            return;
        }
        // SAFETY: the region lies in both buffers.
        unsafe {
            self.device.raw.cmd_copy_buffer(
                self.raw,
                from.raw,
                to.raw,
                &[vk::BufferCopy::default().size(bytes)],
            );
        };
    }
}
