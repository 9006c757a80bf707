//! A tree over triangles of the driver's own, which shaders ask by ray queries, where the device has these.

use super::device::Device;
use super::requirements::has_extensions;
use super::{Buffer, BufferUse, Called, Use};
use crate::error::Result;
use ash::{khr, vk};
use std::sync::Arc;

/// Extensions that ray queries take.
pub(super) const EXTENSIONS: [&std::ffi::CStr; 3] =
    [khr::acceleration_structure::NAME, khr::ray_query::NAME, khr::deferred_host_operations::NAME];

/// One corner, in the first three words of a texel.
type Corner = [u32; 4];
/// `VkAccelerationStructureInstanceKHR`.
type Instance = [u32; 16];

/// Whether a device has all that ray queries take.
pub(super) fn there(instance: &ash::Instance, physical: vk::PhysicalDevice) -> bool {
    if !has_extensions(instance, physical, &EXTENSIONS) {
        return false;
    }
    let mut addresses = vk::PhysicalDeviceBufferDeviceAddressFeatures::default();
    let mut structures = vk::PhysicalDeviceAccelerationStructureFeaturesKHR::default();
    let mut queries = vk::PhysicalDeviceRayQueryFeaturesKHR::default();
    let mut features = vk::PhysicalDeviceFeatures2::default()
        .push_next(&mut addresses)
        .push_next(&mut structures)
        .push_next(&mut queries);
    // SAFETY: the device belongs to the instance; the chain outlives the call, and its extensions are there.
    unsafe { instance.get_physical_device_features2(physical, &mut features) };
    [addresses.buffer_device_address, structures.acceleration_structure, queries.ray_query] == [vk::TRUE; 3]
}

/// Of what the address of a build's scratch memory is a multiple, bytes.
pub(super) fn scratch_alignment(instance: &ash::Instance, physical: vk::PhysicalDevice) -> u64 {
    let mut structures = vk::PhysicalDeviceAccelerationStructurePropertiesKHR::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut structures);
    // SAFETY: the device belongs to the instance, and its extensions are there.
    unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
    structures.min_acceleration_structure_scratch_offset_alignment.max(1).into()
}

/// A tree over triangles, numbered in their order.
pub struct RayTree {
    pub(super) top: Structure,
    // Kept by the instance in `top`.
    _triangles: Option<Structure>,
}

impl RayTree {
    /// The tree over triangles of three corners each, whose first three words are floats.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short, or where the device has no ray queries.
    pub fn new(device: &Arc<Device>, corners: &[Corner]) -> Result<Self> {
        let triangles = (!corners.is_empty()).then(|| of_triangles(device, corners)).transpose()?;
        let instances: Vec<Instance> = triangles.iter().map(instance).collect();
        let placed = Buffer::with(device, "ray tree's instances", BufferUse::RayTreeInput, &instances)?;
        let data = vk::AccelerationStructureGeometryInstancesDataKHR::default()
            .data(vk::DeviceOrHostAddressConstKHR { device_address: placed.address() });
        let geometry = vk::AccelerationStructureGeometryKHR::default()
            .geometry_type(vk::GeometryTypeKHR::INSTANCES)
            .geometry(vk::AccelerationStructureGeometryDataKHR { instances: data });
        let kind = vk::AccelerationStructureTypeKHR::TOP_LEVEL;
        let top = Structure::build(device, kind, geometry, instances.len() as u32)?;
        Ok(Self { top, _triangles: triangles })
    }
}

fn of_triangles(device: &Arc<Device>, corners: &[Corner]) -> Result<Structure> {
    let buffer = Buffer::with(device, "ray tree's corners", BufferUse::RayTreeInput, corners)?;
    let data = vk::AccelerationStructureGeometryTrianglesDataKHR::default()
        .vertex_format(vk::Format::R32G32B32_SFLOAT)
        .vertex_data(vk::DeviceOrHostAddressConstKHR { device_address: buffer.address() })
        .vertex_stride(size_of::<Corner>() as vk::DeviceSize)
        .max_vertex(corners.len() as u32 - 1)
        .index_type(vk::IndexType::NONE_KHR);
    let geometry = vk::AccelerationStructureGeometryKHR::default()
        .geometry_type(vk::GeometryTypeKHR::TRIANGLES)
        .geometry(vk::AccelerationStructureGeometryDataKHR { triangles: data })
        // Shaders decide what meets a ray, once for each triangle.
        .flags(vk::GeometryFlagsKHR::NO_DUPLICATE_ANY_HIT_INVOCATION);
    let kind = vk::AccelerationStructureTypeKHR::BOTTOM_LEVEL;
    Structure::build(device, kind, geometry, corners.len() as u32 / 3)
}

/// A structure where it is: not turned, not moved, seen by every ray from either side.
fn instance(structure: &Structure) -> Instance {
    let address = structure.address();
    let one = 1.0_f32.to_bits();
    let flags = vk::GeometryInstanceFlagsKHR::TRIANGLE_FACING_CULL_DISABLE.as_raw();
    [
        [one, 0, 0, 0],
        [0, one, 0, 0],
        [0, 0, one, 0],
        [0xff << 24, flags << 24, address as u32, (address >> 32) as u32],
    ]
    .as_flattened()
    .try_into()
    .unwrap_or_default()
}

/// An acceleration structure and its memory.
pub(super) struct Structure {
    pub(super) raw: vk::AccelerationStructureKHR,
    _memory: Buffer<Corner>,
    device: Arc<Device>,
}

impl Structure {
    /// Builds it on the device, and waits.
    fn build(
        device: &Arc<Device>,
        kind: vk::AccelerationStructureTypeKHR,
        geometry: vk::AccelerationStructureGeometryKHR<'_>,
        count: u32,
    ) -> Result<Self> {
        let rays = device.rays()?;
        let geometries = [geometry];
        let mut info = vk::AccelerationStructureBuildGeometryInfoKHR::default()
            .ty(kind)
            .flags(vk::BuildAccelerationStructureFlagsKHR::PREFER_FAST_TRACE)
            .mode(vk::BuildAccelerationStructureModeKHR::BUILD)
            .geometries(&geometries);
        let mut sizes = vk::AccelerationStructureBuildSizesInfoKHR::default();
        let place = vk::AccelerationStructureBuildTypeKHR::DEVICE;
        // SAFETY: one geometry, and one count.
        unsafe { rays.get_acceleration_structure_build_sizes(place, &info, &[count], &mut sizes) };
        let structure = Self::new(device, kind, sizes.acceleration_structure_size)?;
        let scratch = Scratch::new(device, sizes.build_scratch_size)?;
        info = info
            .dst_acceleration_structure(structure.raw)
            .scratch_data(vk::DeviceOrHostAddressKHR { device_address: scratch.address });
        let range = [vk::AccelerationStructureBuildRangeInfoKHR::default().primitive_count(count)];
        device.run("ray tree", |cmd| {
            // SAFETY: structure and scratch have the sizes asked for, and the input is kept by the caller.
            unsafe { rays.cmd_build_acceleration_structures(cmd.raw, &[info], &[&range]) };
            cmd.memory_barrier(Use::RayTree, Use::RayTree);
            Ok(())
        })?;
        Ok(structure)
    }

    fn new(device: &Arc<Device>, kind: vk::AccelerationStructureTypeKHR, bytes: u64) -> Result<Self> {
        let texels = bytes.div_ceil(size_of::<Corner>() as u64) as usize;
        let memory = Buffer::<Corner>::new(device, "ray tree", BufferUse::RayTree, texels)?;
        let info = vk::AccelerationStructureCreateInfoKHR::default().buffer(memory.raw).size(bytes).ty(kind);
        // SAFETY: the buffer is that large, and made for this.
        let raw = unsafe { device.rays()?.create_acceleration_structure(&info, None) }
            .called("vkCreateAccelerationStructureKHR")?;
        Ok(Self { raw, _memory: memory, device: device.clone() })
    }

    fn address(&self) -> u64 {
        let info = vk::AccelerationStructureDeviceAddressInfoKHR::default().acceleration_structure(self.raw);
        // SAFETY: the structure is alive.
        self.device.rays().map_or(0, |rays| unsafe { rays.get_acceleration_structure_device_address(&info) })
    }
}

impl Drop for Structure {
    fn drop(&mut self) {
        if let Ok(rays) = self.device.rays() {
            // SAFETY: no work is pending outside `Device::run`.
            unsafe { rays.destroy_acceleration_structure(self.raw, None) };
        }
    }
}

/// Memory that a build needs meanwhile, at an address that the device takes.
struct Scratch {
    address: u64,
    _memory: Buffer<Corner>,
}

impl Scratch {
    fn new(device: &Arc<Device>, bytes: u64) -> Result<Self> {
        let alignment = device.scratch_alignment();
        let texels = (bytes + alignment).div_ceil(size_of::<Corner>() as u64) as usize;
        let memory = Buffer::<Corner>::new(device, "ray tree's scratch", BufferUse::RayTreeScratch, texels)?;
        Ok(Self { address: memory.address().next_multiple_of(alignment), _memory: memory })
    }
}
