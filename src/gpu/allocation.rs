//! Memory of buffers and images: `gpu-allocator` behind the crate's only lock, and a count of the bytes in use.

use super::{Called, device::Device};
use crate::error::{Error, Result};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};
use std::sync::{Mutex, PoisonError};

/// The allocator; locked for the length of one call.
pub(super) struct Memory(Mutex<State>);

struct State {
    // `None` once the device is being destroyed: the allocator must go before it.
    allocator: Option<Allocator>,
    used: u64,
    peak: u64,
}

impl Memory {
    pub(super) fn new(
        instance: &ash::Instance,
        device: &ash::Device,
        physical: vk::PhysicalDevice,
        addresses: bool,
    ) -> Result<Self> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.clone(),
            device: device.clone(),
            physical_device: physical,
            debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
            buffer_device_address: addresses,
            allocation_sizes: gpu_allocator::AllocationSizes::default(),
        })
        .map_err(|error| out_of_memory("the memory allocator", &error))?;
        Ok(Self(Mutex::new(State { allocator: Some(allocator), used: 0, peak: 0 })))
    }

    pub(super) fn allocate(
        &self,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Allocation> {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let allocator = state.allocator.as_mut().ok_or_else(|| Error::Vulkan {
            call: format!("memory of {name}"),
            result: "the device is gone".into(),
            remedy: "report this".into(),
        })?;
        let allocation = allocator
            .allocate(&AllocationCreateDesc {
                name,
                requirements,
                location,
                linear,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            })
            .map_err(|error| out_of_memory(name, &error))?;
        state.used += allocation.size();
        state.peak = state.peak.max(state.used);
        Ok(allocation)
    }

    pub(super) fn free(&self, allocation: Allocation) {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        state.used = state.used.saturating_sub(allocation.size());
        if let Some(allocator) = state.allocator.as_mut() {
            // Fails only for an allocation of another allocator, and there is one.
            let _ = allocator.free(allocation);
        }
    }

    pub(super) fn peak(&self) -> u64 {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).peak
    }

    /// Returns every block to the driver; only the device's `Drop` calls this.
    pub(super) fn close(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).allocator = None;
    }
}

fn out_of_memory(name: &str, error: &gpu_allocator::AllocationError) -> Error {
    Error::Vulkan {
        call: format!("memory of {name}"),
        result: error.to_string(),
        remedy: "render a smaller picture or fewer lights, or free memory".into(),
    }
}

impl Device {
    pub(super) fn allocate_for_buffer(
        &self,
        name: &str,
        buffer: vk::Buffer,
        location: MemoryLocation,
    ) -> Result<Allocation> {
        // SAFETY: the buffer was made by this device.
        let requirements = unsafe { self.raw.get_buffer_memory_requirements(buffer) };
        let allocation = self.memory.allocate(name, requirements, location, true)?;
        // SAFETY: the memory is fresh, large enough and of an allowed type, as the allocator promises.
        unsafe { self.raw.bind_buffer_memory(buffer, allocation.memory(), allocation.offset()) }
            .called("vkBindBufferMemory")?;
        Ok(allocation)
    }

    pub(super) fn allocate_for_image(&self, name: &str, image: vk::Image) -> Result<Allocation> {
        // SAFETY: the image was made by this device.
        let requirements = unsafe { self.raw.get_image_memory_requirements(image) };
        let allocation = self.memory.allocate(name, requirements, MemoryLocation::GpuOnly, false)?;
        // SAFETY: as for buffers.
        unsafe { self.raw.bind_image_memory(image, allocation.memory(), allocation.offset()) }
            .called("vkBindImageMemory")?;
        Ok(allocation)
    }
}
