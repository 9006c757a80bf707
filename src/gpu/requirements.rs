//! What amas needs of a device, in one table; a missing thing is a sentence.

use ash::vk;
use std::ffi::CStr;

/// What a check may look at.
pub(super) struct Facts<'a> {
    pub(super) instance: &'a ash::Instance,
    pub(super) device: vk::PhysicalDevice,
    pub(super) properties: vk::PhysicalDeviceProperties,
    pub(super) queues: Vec<vk::QueueFamilyProperties>,
}

/// One row of the table, as it came out on a device.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Check {
    /// What is asked for.
    pub name: String,
    /// What the device has.
    pub found: String,
    /// Why amas needs it.
    pub why: &'static str,
    /// Whether that is enough.
    pub ok: bool,
}

/// All rows of the table on one device.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub struct Report(pub Vec<Check>);

impl Report {
    /// The missing things as one sentence; `None` where nothing is missing.
    #[must_use]
    pub fn missing(&self) -> Option<String> {
        let missing: Vec<String> = self
            .0
            .iter()
            .filter(|check| !check.ok)
            .map(|check| format!("it needs {} ({}), and has {}", check.name, check.why, check.found))
            .collect();
        (!missing.is_empty()).then(|| missing.join("; "))
    }
}

/// Whether a device has all of these extensions.
pub(super) fn has_extensions(instance: &ash::Instance, device: vk::PhysicalDevice, names: &[&CStr]) -> bool {
    // SAFETY: the device belongs to the instance.
    let found = unsafe { instance.enumerate_device_extension_properties(device) }.unwrap_or_default();
    let has = |name| found.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name));
    names.iter().all(|name| has(name))
}

type Limit = (&'static str, u64, fn(&vk::PhysicalDeviceLimits) -> u64, &'static str);

/// Limits above what Vulkan guarantees, or close to it.
const LIMITS: &[Limit] = &[
    ("maxBoundDescriptorSets", 4, |l| l.max_bound_descriptor_sets.into(), "frame, scene and material sets"),
    (
        "maxComputeWorkGroupInvocations",
        256,
        |l| l.max_compute_work_group_invocations.into(),
        "the scan of the cluster pass",
    ),
    (
        "maxComputeWorkGroupSize[0]",
        256,
        |l| l.max_compute_work_group_size[0].into(),
        "the scan of the cluster pass",
    ),
    ("maxPushConstantsSize", 128, |l| l.max_push_constants_size.into(), "per-draw constants"),
    ("maxImageArrayLayers", 256, |l| l.max_image_array_layers.into(), "light lists in texture arrays"),
    ("maxImageDimension2D", 4096, |l| l.max_image_dimension2_d.into(), "a million lights in one layer"),
    (
        "maxPerStageDescriptorSampledImages",
        16,
        |l| l.max_per_stage_descriptor_sampled_images.into(),
        "8 material textures beside the light lists",
    ),
    ("maxStorageBufferRange", 1 << 27, |l| l.max_storage_buffer_range.into(), "clusters of a large picture"),
];

type FormatRow = (&'static str, vk::Format, vk::FormatFeatureFlags, &'static str);

const FORMATS: &[FormatRow] = &[
    (
        "D32_SFLOAT, depth and sampled",
        vk::Format::D32_SFLOAT,
        vk::FormatFeatureFlags::from_raw(
            vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT.as_raw()
                | vk::FormatFeatureFlags::SAMPLED_IMAGE.as_raw(),
        ),
        "reversed-Z prepass",
    ),
    (
        "R32G32B32A32_SFLOAT, colour with blending",
        vk::Format::R32G32B32A32_SFLOAT,
        vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND,
        "subpasses add up in float32",
    ),
    (
        "R32G32B32A32_SFLOAT, storage",
        vk::Format::R32G32B32A32_SFLOAT,
        vk::FormatFeatureFlags::STORAGE_IMAGE,
        "compute adds up in float32",
    ),
    (
        "R32G32B32A32_UINT, colour",
        vk::Format::R32G32B32A32_UINT,
        vk::FormatFeatureFlags::COLOR_ATTACHMENT,
        "surfaces for compute",
    ),
    (
        "R32_UINT, storage",
        vk::Format::R32_UINT,
        vk::FormatFeatureFlags::STORAGE_IMAGE,
        "cluster id per pixel",
    ),
    (
        "R32G32B32A32_UINT, storage",
        vk::Format::R32G32B32A32_UINT,
        vk::FormatFeatureFlags::STORAGE_IMAGE,
        "light lists, four indices a texel",
    ),
    (
        "R16G16B16A16_SFLOAT, linear filter",
        vk::Format::R16G16B16A16_SFLOAT,
        vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR,
        "floating-point textures",
    ),
];

/// Fills the table for one device.
pub(super) fn check(facts: &Facts<'_>) -> Report {
    let mut rows = vec![api_version(facts), queue(facts)];
    rows.extend(LIMITS.iter().map(|&(name, least, read, why)| {
        let found = read(&facts.properties.limits);
        Check { name: format!("{name} ≥ {least}"), found: found.to_string(), why, ok: found >= least }
    }));
    rows.extend(FORMATS.iter().map(|&(name, format, needed, why)| {
        // SAFETY: the device belongs to the instance.
        let found = unsafe { facts.instance.get_physical_device_format_properties(facts.device, format) };
        let ok = found.optimal_tiling_features.contains(needed);
        Check { name: name.into(), found: if ok { "it" } else { "no such use of it" }.into(), why, ok }
    }));
    Report(rows)
}

fn api_version(facts: &Facts<'_>) -> Check {
    let version = facts.properties.api_version;
    Check {
        name: "Vulkan ≥ 1.2".into(),
        found: version_text(version),
        why: "the shaders' SPIR-V 1.5",
        ok: version >= vk::API_VERSION_1_2,
    }
}

fn queue(facts: &Facts<'_>) -> Check {
    let ok = queue_families(&facts.queues).next().is_some();
    Check {
        name: "a queue for graphics and compute".into(),
        found: if ok { "one" } else { "none" }.into(),
        why: "one frame, one queue",
        ok,
    }
}

/// Families with graphics and compute.
pub(super) fn queue_families(queues: &[vk::QueueFamilyProperties]) -> impl Iterator<Item = u32> {
    let wanted = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    (0_u32..)
        .zip(queues)
        .filter(move |(_, family)| family.queue_flags.contains(wanted))
        .map(|(index, _)| index)
}

/// `1.3.230`.
pub(super) fn version_text(version: u32) -> String {
    format!(
        "{}.{}.{}",
        vk::api_version_major(version),
        vk::api_version_minor(version),
        vk::api_version_patch(version)
    )
}
