//! How the logical device is made: queue, features, and what belongs to it from the start.

use super::Device;
use crate::error::Result;
use crate::gpu::allocation::Memory;
use crate::gpu::cache::Cache;
use crate::gpu::candidate::Candidate;
use crate::gpu::instance::Instance;
use crate::gpu::pipeline::Compiled;
use crate::gpu::{Called, ray_tree};
use ash::{khr, vk};
use std::ffi::CStr;
use std::path::Path;
use std::sync::{Arc, Mutex, RwLock};

impl Device {
    /// Of a chosen candidate, with those extensions.
    pub(super) fn create(
        instance: Arc<Instance>,
        chosen: Candidate,
        extensions: &[&'static CStr],
        cache: Option<&Path>,
    ) -> Result<Self> {
        let extensions: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
        let priorities = [1.0];
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(chosen.family)
            .queue_priorities(&priorities)];
        // SAFETY: the device belongs to the instance.
        let supported = unsafe { instance.raw.get_physical_device_features(chosen.physical) };
        let features = vk::PhysicalDeviceFeatures {
            sampler_anisotropy: supported.sampler_anisotropy,
            // All vertices lie in one buffer; without it their indices end at 2²⁴.
            full_draw_index_uint32: supported.full_draw_index_uint32,
            ..vk::PhysicalDeviceFeatures::default()
        };
        let queries = chosen.info.ray_queries;
        let mut addresses =
            vk::PhysicalDeviceBufferDeviceAddressFeatures::default().buffer_device_address(true);
        let mut structures =
            vk::PhysicalDeviceAccelerationStructureFeaturesKHR::default().acceleration_structure(true);
        let mut ray_queries = vk::PhysicalDeviceRayQueryFeaturesKHR::default().ray_query(true);
        let mut info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&extensions)
            .enabled_features(&features);
        if queries {
            info = info.push_next(&mut addresses).push_next(&mut structures).push_next(&mut ray_queries);
        }
        // SAFETY: the queue family exists, and only supported features and extensions are turned on.
        let raw =
            unsafe { instance.raw.create_device(chosen.physical, &info, None) }.called("vkCreateDevice")?;
        // SAFETY: queue 0 of the family was asked for above.
        let queue = unsafe { raw.get_device_queue(chosen.family, 0) };
        let pool = command_pool(&raw, chosen.family)?;
        let debug = instance.debug_utils.then(|| ash::ext::debug_utils::Device::new(&instance.raw, &raw));
        let memory = Memory::new(&instance.raw, &raw, chosen.physical, queries)?;
        let cache = cache.map_or_else(
            || Ok(Cache::none()),
            |folder| {
                // SAFETY: the device belongs to the instance.
                let properties = unsafe { instance.raw.get_physical_device_properties(chosen.physical) };
                Cache::below(folder, &raw, &properties)
            },
        )?;
        Ok(Self {
            memory,
            debug,
            limits: chosen.limits,
            timestamp_bits: chosen.timestamp_bits,
            max_anisotropy: (supported.sampler_anisotropy == vk::TRUE)
                .then_some(chosen.limits.max_sampler_anisotropy),
            physical: chosen.physical,
            rays: queries.then(|| khr::acceleration_structure::Device::new(&instance.raw, &raw)),
            scratch_alignment: if queries {
                ray_tree::scratch_alignment(&instance.raw, chosen.physical)
            } else {
                1
            },
            info: chosen.info,
            queue,
            #[cfg(feature = "viewer")]
            family: chosen.family,
            pool,
            cache,
            compiled: Compiled::default(),
            replaced: RwLock::default(),
            turn: Mutex::new(()),
            instance,
            raw,
        })
    }
}

pub(super) fn command_pool(raw: &ash::Device, family: u32) -> Result<vk::CommandPool> {
    let info = vk::CommandPoolCreateInfo::default()
        .queue_family_index(family)
        .flags(vk::CommandPoolCreateFlags::TRANSIENT);
    // SAFETY: the device is alive, and was made with a queue of the family.
    unsafe { raw.create_command_pool(&info, None) }.called("vkCreateCommandPool")
}
