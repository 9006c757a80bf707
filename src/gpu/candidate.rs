//! The choice of a device: every candidate with what it lacks.

use super::Called;
use super::device::DeviceInfo;
use super::instance::Instance;
use super::ray_tree;
use super::requirements::{self, Check, Facts};
use crate::error::{Error, Result};
use ash::vk;

/// Where pictures go besides memory: a window's surface.
pub(super) trait Presentation {
    /// Whether a queue family presents to it.
    fn presents(&self, physical: vk::PhysicalDevice, family: u32) -> bool;

    /// What it needs of a device beyond rendering; `family` is the first that renders and presents.
    fn checks(&self, physical: vk::PhysicalDevice, family: Option<u32>) -> Vec<Check>;
}

/// A device that may be chosen.
pub(super) struct Candidate {
    pub(super) physical: vk::PhysicalDevice,
    pub(super) info: DeviceInfo,
    pub(super) limits: vk::PhysicalDeviceLimits,
    pub(super) family: u32,
    pub(super) timestamp_bits: u32,
    rank: u32,
}

/// Every device of the machine, with what it lacks.
pub(super) fn candidates(
    instance: &Instance,
    presentation: Option<&dyn Presentation>,
) -> Result<Vec<Candidate>> {
    // SAFETY: the instance is alive.
    let devices =
        unsafe { instance.raw.enumerate_physical_devices() }.called("vkEnumeratePhysicalDevices")?;
    Ok(devices.into_iter().map(|physical| describe(&instance.raw, physical, presentation)).collect())
}

fn describe(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    presentation: Option<&dyn Presentation>,
) -> Candidate {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: the device belongs to the instance; the chain outlives the call.
    unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
    let properties = properties.properties;
    // SAFETY: as above.
    let queues = unsafe { instance.get_physical_device_queue_family_properties(physical) };
    let family = requirements::queue_families(&queues)
        .find(|&family| presentation.is_none_or(|target| target.presents(physical, family)));
    let timestamp_bits =
        family.and_then(|family| queues.get(family as usize)).map_or(0, |queue| queue.timestamp_valid_bits);
    let (kind, rank) = match properties.device_type {
        vk::PhysicalDeviceType::DISCRETE_GPU => ("discrete", 0),
        vk::PhysicalDeviceType::INTEGRATED_GPU => ("integrated", 1),
        vk::PhysicalDeviceType::VIRTUAL_GPU => ("virtual", 2),
        vk::PhysicalDeviceType::CPU => ("cpu", 3),
        _ => ("other", 4),
    };
    let text = |raw: Result<&std::ffi::CStr, _>| {
        raw.map_or_else(|_| "?".into(), |s| s.to_string_lossy().into_owned())
    };
    let mut report = requirements::check(&Facts { instance, device: physical, properties, queues });
    if let Some(target) = presentation {
        report.0.extend(target.checks(physical, family));
    }
    let info = DeviceInfo {
        name: text(properties.device_name_as_c_str()),
        driver: format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str())),
        api: requirements::version_text(properties.api_version),
        kind,
        ray_queries: properties.api_version >= vk::API_VERSION_1_2 && ray_tree::there(instance, physical),
        pipeline_statistics: requirements::has_extensions(
            instance,
            physical,
            &[ash::khr::pipeline_executable_properties::NAME],
        ),
        report,
    };
    Candidate {
        physical,
        info,
        limits: properties.limits,
        // Without a family the report has a row that is not met, and the device is never opened.
        family: family.unwrap_or(0),
        timestamp_bits,
        rank,
    }
}

/// The device of that index or name, or the best that lacks nothing.
pub(super) fn choose(mut candidates: Vec<Candidate>, wanted: Option<&str>) -> Result<Candidate> {
    if candidates.is_empty() {
        return Err(Error::NoDevice {
            cause: "the machine has no Vulkan driver".into(),
            remedy: "run ./setup, or install a driver; mesa-vulkan-drivers renders on the CPU".into(),
        });
    }
    let names: Vec<String> =
        candidates.iter().enumerate().map(|(i, candidate)| format!("{i}: {}", candidate.info.name)).collect();
    let index = match wanted {
        Some(wanted) => find(&candidates, wanted),
        None => (0..candidates.len())
            .filter(|&i| candidates[i].info.report.missing().is_none())
            .min_by_key(|&i| candidates[i].rank),
    };
    match index {
        Some(index) => {
            let chosen = candidates.swap_remove(index);
            match chosen.info.report.missing() {
                None => Ok(chosen),
                Some(missing) => Err(unusable(&format!("{}: {missing}", chosen.info.name))),
            }
        }
        None if wanted.is_some() => Err(Error::NoDevice {
            cause: format!(
                "no device is named {:?}; the machine has {}",
                wanted.unwrap_or_default(),
                names.join(", ")
            ),
            remedy: "choose one of these with --device NAME or --device INDEX".into(),
        }),
        None => {
            let reasons: Vec<String> = candidates
                .iter()
                .map(|c| format!("{}: {}", c.info.name, c.info.report.missing().unwrap_or_default()))
                .collect();
            Err(unusable(&reasons.join("; ")))
        }
    }
}

fn unusable(cause: &str) -> Error {
    Error::NoDevice {
        cause: cause.into(),
        remedy: "update the driver, or install mesa-vulkan-drivers".into(),
    }
}

fn find(candidates: &[Candidate], wanted: &str) -> Option<usize> {
    if let Ok(index) = wanted.parse::<usize>() {
        return (index < candidates.len()).then_some(index);
    }
    let wanted = wanted.to_lowercase();
    candidates.iter().position(|candidate| {
        candidate.info.name.to_lowercase().contains(&wanted)
            || candidate.info.driver.to_lowercase().contains(&wanted)
    })
}
