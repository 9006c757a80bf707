//! The device: chosen by what amas needs, with one queue, one command pool and the allocator.

mod create;

use super::allocation::Memory;
use super::cache::Cache;
use super::candidate::{Presentation, candidates, choose};
use super::instance::Instance;
use super::pipeline::Compiled;
use super::ray_tree;
use super::requirements::Report;
use super::{Called, Commands, Shader};
use crate::error::{Error, Result};
use ash::{khr, vk};
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, RwLock};

/// SPIR-V in the place of what the program was built with, by the names of the shaders and whether with ray
/// queries.
pub type Replaced = HashMap<(&'static str, bool), Vec<u32>>;

/// How to open a device.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Index, or part of a name; without it the best usable device is taken.
    pub device: Option<String>,
    /// Turn on the validation layers with synchronisation checks.
    pub validate: bool,
    /// Whether rays are traced by ray queries where the device has them; by default, where it is no CPU.
    pub ray_queries: Option<bool>,
}

/// What a device is, and what it lacks.
#[derive(Clone, Debug, serde::Serialize)]
pub struct DeviceInfo {
    /// As the driver names it.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Vulkan version.
    pub api: String,
    /// discrete, integrated, virtual, cpu or other.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// Whether rays are traced by ray queries.
    pub ray_queries: bool,
    /// Whether the driver tells what it makes of a pipeline: instructions, registers.
    pub pipeline_statistics: bool,
    /// What amas needs, row by row.
    #[serde(skip)]
    pub report: Report,
}

/// A logical device with its queue.
pub struct Device {
    pub(super) raw: ash::Device,
    pub(super) memory: Memory,
    pub(super) debug: Option<ash::ext::debug_utils::Device>,
    pub(super) limits: vk::PhysicalDeviceLimits,
    pub(super) timestamp_bits: u32,
    pub(super) max_anisotropy: Option<f32>,
    pub(super) physical: vk::PhysicalDevice,
    rays: Option<khr::acceleration_structure::Device>,
    scratch_alignment: u64,
    info: DeviceInfo,
    queue: vk::Queue,
    #[cfg(feature = "viewer")]
    pub(super) family: u32,
    pool: vk::CommandPool,
    pub(super) cache: Cache,
    pub(super) compiled: Compiled,
    // Shaders that changed since the program was built, by their names.
    replaced: RwLock<Replaced>,
    // Queue and pool are used by one thread at a time.
    turn: Mutex<()>,
    // Shared with the surface, which may be destroyed later than the device.
    instance: Arc<Instance>,
}

impl Device {
    /// Opens a device.
    ///
    /// # Errors
    /// [`Error::NoDevice`] where none answers or none suffices, with the reason for each.
    pub fn open(options: &Options) -> Result<Arc<Self>> {
        Self::open_on(Instance::new(options.validate)?, options, None, None)
    }

    /// Opens a device that can also present, where a presentation is given; pipelines are kept in the folder, if there is one.
    pub(super) fn open_on(
        instance: Arc<Instance>,
        options: &Options,
        presentation: Option<&dyn Presentation>,
        cache: Option<&Path>,
    ) -> Result<Arc<Self>> {
        let candidates = candidates(&instance, presentation)?;
        let mut chosen = choose(candidates, options.device.as_deref())?;
        chosen.info.ray_queries &= options.ray_queries.unwrap_or(chosen.info.kind != "cpu");
        let mut extensions: Vec<_> = presentation.iter().map(|_| khr::swapchain::NAME).collect();
        if chosen.info.ray_queries {
            extensions.extend(ray_tree::EXTENSIONS);
        }
        Self::create(instance, chosen, &extensions, cache).map(Arc::new)
    }

    /// Every device of the machine, with what it lacks.
    ///
    /// # Errors
    /// [`Error::NoDevice`] without a loader.
    pub fn enumerate() -> Result<Vec<DeviceInfo>> {
        let instance = Instance::new(false)?;
        Ok(candidates(&instance, None)?.into_iter().map(|candidate| candidate.info).collect())
    }

    /// What the device is.
    #[must_use]
    pub fn info(&self) -> &DeviceInfo {
        &self.info
    }

    /// Whether the device is a software rasteriser.
    #[must_use]
    pub fn is_cpu(&self) -> bool {
        self.info.kind == "cpu"
    }

    /// Whether shaders trace rays by ray queries.
    #[must_use]
    pub fn has_ray_queries(&self) -> bool {
        self.rays.is_some()
    }

    /// What ray trees are made with.
    pub(super) fn rays(&self) -> Result<&khr::acceleration_structure::Device> {
        self.rays.as_ref().ok_or_else(|| Error::Vulkan {
            call: "ray tree".into(),
            result: "the device has no ray queries".into(),
            remedy: "report this".into(),
        })
    }

    /// Of what the address of a build's scratch memory is a multiple, bytes.
    pub(super) fn scratch_alignment(&self) -> u64 {
        self.scratch_alignment
    }

    /// Writes the pipelines compiled so far to the folder that keeps them, if there is one.
    pub fn keep_pipelines(&self) {
        self.cache.save(&self.raw);
    }

    /// Texels along a side of the largest texture.
    #[must_use]
    pub fn largest_image(&self) -> u32 {
        self.limits.max_image_dimension2_d
    }

    /// Largest number of device bytes in use at once so far.
    #[must_use]
    pub fn peak_memory(&self) -> u64 {
        self.memory.peak()
    }

    /// What the validation layers said so far; `None` where they are off.
    #[must_use]
    pub fn validation_messages(&self) -> Option<Vec<String>> {
        self.instance.log.as_ref().map(|log| log.messages())
    }

    /// [`Error::Validation`] if the validation layers said anything.
    ///
    /// # Errors
    /// See above.
    pub fn require_silence(&self) -> Result<()> {
        match self.validation_messages().unwrap_or_default() {
            messages if messages.is_empty() => Ok(()),
            messages => Err(Error::Validation { count: messages.len(), first: messages[0].clone() }),
        }
    }

    /// Records commands, submits them and waits until the device has finished.
    ///
    /// # Errors
    /// [`Error::Vulkan`] from recording or from the driver.
    pub fn run<T>(
        self: &Arc<Self>,
        name: &str,
        record: impl FnOnce(&mut Commands) -> Result<T>,
    ) -> Result<T> {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        let info = vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
        // SAFETY: the pool belongs to this device, and this thread has the turn.
        let buffers =
            unsafe { self.raw.allocate_command_buffers(&info) }.called("vkAllocateCommandBuffers")?;
        let recorded = Commands::record(self, buffers[0], name, |cmd| {
            let value = record(cmd)?;
            cmd.visible_to_all();
            Ok(value)
        });
        let result = recorded.and_then(|value| {
            self.submit_and_wait(buffers[0])?;
            Ok(value)
        });
        // SAFETY: the buffer is not pending: it was waited for, or never submitted.
        unsafe { self.raw.free_command_buffers(self.pool, &buffers) };
        result
    }

    fn submit_and_wait(&self, buffer: vk::CommandBuffer) -> Result<()> {
        let buffers = [buffer];
        let submits = [vk::SubmitInfo::default().command_buffers(&buffers)];
        // SAFETY: the buffer is fully recorded, and is not resubmitted.
        unsafe { self.raw.queue_submit(self.queue, &submits, vk::Fence::null()) }.called("vkQueueSubmit")?;
        // SAFETY: this thread has the turn.
        unsafe { self.raw.queue_wait_idle(self.queue) }.called("vkQueueWaitIdle")
    }

    /// Has pipelines that are made from now on use other shaders; what they were to use before.
    #[cfg(feature = "viewer")]
    pub fn replace_shaders(&self, replaced: Replaced) -> Replaced {
        std::mem::replace(&mut self.replaced.write().unwrap_or_else(PoisonError::into_inner), replaced)
    }

    /// The words of a shader, as built or replaced.
    pub(super) fn words(&self, shader: Shader) -> Vec<u32> {
        self.replaced(shader).unwrap_or_else(|| shader.words(self.has_ray_queries()))
    }

    /// Of which of its words a shader is made.
    fn kind(&self, shader: Shader) -> (&'static str, bool) {
        (shader.name, shader.kinds().any(|ray_queries| ray_queries && self.has_ray_queries()))
    }

    /// The words in a shader's place, if there are any.
    pub(super) fn replaced(&self, shader: Shader) -> Option<Vec<u32>> {
        self.replaced.read().unwrap_or_else(PoisonError::into_inner).get(&self.kind(shader)).cloned()
    }

    /// Hands the queue to `call`, which no other thread uses meanwhile.
    #[cfg(feature = "viewer")]
    pub(super) fn with_queue<T>(&self, call: impl FnOnce(vk::Queue) -> T) -> T {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        call(self.queue)
    }

    /// A pool whose commands are recorded again and again.
    #[cfg(feature = "viewer")]
    pub(super) fn command_pool(&self) -> Result<vk::CommandPool> {
        create::command_pool(&self.raw, self.family)
    }

    #[cfg(feature = "viewer")]
    pub(super) fn semaphore(&self) -> Result<vk::Semaphore, vk::Result> {
        // SAFETY: the device is alive.
        unsafe { self.raw.create_semaphore(&vk::SemaphoreCreateInfo::default(), None) }
    }

    #[cfg(feature = "viewer")]
    pub(super) fn swapchain_loader(&self) -> khr::swapchain::Device {
        khr::swapchain::Device::new(&self.instance.raw, &self.raw)
    }

    /// The largest image of this format, kind and usage.
    pub(super) fn image_limits(&self, info: &vk::ImageCreateInfo<'_>) -> Result<vk::ImageFormatProperties> {
        // SAFETY: the device belongs to the instance.
        unsafe {
            self.instance.raw.get_physical_device_image_format_properties(
                self.physical,
                info.format,
                info.image_type,
                info.tiling,
                info.usage,
                info.flags,
            )
        }
        .called("vkGetPhysicalDeviceImageFormatProperties")
    }

    /// Names an object in captures and validation messages.
    pub(super) fn name<H: vk::Handle>(&self, handle: H, name: &str) {
        let (Some(debug), Ok(name)) = (&self.debug, std::ffi::CString::new(name)) else {
            return;
        };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: the handle is alive. A name that cannot be set is no reason to stop.
        let _ = unsafe { debug.set_debug_utils_object_name(&info) };
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        self.memory.close();
        self.cache.destroy(&self.raw);
        // SAFETY: everything made from the device holds it by `Arc` and is gone; nothing is pending after `run`.
        unsafe { self.raw.destroy_command_pool(self.pool, None) };
        // SAFETY: as above.
        unsafe { self.raw.destroy_device(None) };
    }
}
