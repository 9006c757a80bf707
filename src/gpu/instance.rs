//! The instance, and what the validation layers say.

use super::Called;
use crate::error::{Error, Result};
use ash::vk;
use std::ffi::{CStr, c_char, c_void};
use std::sync::{Arc, Mutex, PoisonError};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Messages of the validation layers, warnings and errors alike.
#[derive(Default)]
pub(super) struct ValidationLog(Mutex<Vec<String>>);

impl ValidationLog {
    pub(super) fn messages(&self) -> Vec<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn push(&self, message: String) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(message);
    }
}

/// `VkInstance` with an optional debug messenger.
pub(super) struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) log: Option<Arc<ValidationLog>>,
    pub(super) debug_utils: bool,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    // The loader's library must outlive every handle made through it.
    pub(super) entry: ash::Entry,
}

impl Instance {
    /// Loads Vulkan. With `validate`, turns on the validation layers with synchronisation checks.
    pub(super) fn new(validate: bool) -> Result<Arc<Self>> {
        Self::with(validate, &[], &[])
    }

    /// As [`Instance::new`], with these extensions, and with the colour spaces that windows may have where the driver knows
    /// them.
    #[cfg(feature = "viewer")]
    pub(super) fn for_window(validate: bool, extensions: &[&'static CStr]) -> Result<Arc<Self>> {
        Self::with(validate, extensions, &[ash::ext::swapchain_colorspace::NAME])
    }

    fn with(validate: bool, extensions: &[&'static CStr], welcome: &[&'static CStr]) -> Result<Arc<Self>> {
        // SAFETY: the loader's library is trusted to be Vulkan's; it stays loaded as long as `Instance`.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| Error::NoDevice {
            cause: format!("the Vulkan loader cannot be loaded ({error})"),
            remedy: "run ./setup, or install libvulkan1 and a driver such as mesa-vulkan-drivers".into(),
        })?;
        let found = available_extensions(&entry)?;
        let debug_utils = has(&found, ash::ext::debug_utils::NAME);
        if let Some(missing) = extensions.iter().find(|name| !has(&found, name)) {
            return Err(missing_extension(missing));
        }
        if validate {
            require_validation(&entry)?;
        }
        let mut wanted = extensions.to_vec();
        wanted.extend(welcome.iter().copied().filter(|name| has(&found, name)));
        wanted.extend(debug_utils.then_some(ash::ext::debug_utils::NAME));
        let raw = create(&entry, validate, &wanted)?;
        let mut instance = Self { raw, log: None, debug_utils, messenger: None, entry };
        if validate {
            instance.listen()?;
        }
        Ok(Arc::new(instance))
    }

    /// Whether a device copies pictures to this format by blits.
    #[cfg(feature = "viewer")]
    pub(super) fn blits_to(&self, physical: vk::PhysicalDevice, format: vk::Format) -> bool {
        // SAFETY: the device belongs to the instance.
        let found = unsafe { self.raw.get_physical_device_format_properties(physical, format) };
        found.optimal_tiling_features.contains(vk::FormatFeatureFlags::BLIT_DST)
    }

    fn listen(&mut self) -> Result<()> {
        let log = Arc::new(ValidationLog::default());
        let loader = ash::ext::debug_utils::Instance::new(&self.entry, &self.raw);
        let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
            )
            // Not PERFORMANCE: that a shared vertex module writes more than a fragment shader reads is on purpose.
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(on_message))
            .user_data(Arc::as_ptr(&log).cast_mut().cast());
        // SAFETY: the log outlives the messenger: both live in `self`, and `Drop` destroys the messenger first.
        let messenger = unsafe { loader.create_debug_utils_messenger(&info, None) }
            .called("vkCreateDebugUtilsMessengerEXT")?;
        self.log = Some(log);
        self.messenger = Some((loader, messenger));
        Ok(())
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Some((loader, messenger)) = self.messenger.take() {
            // SAFETY: the messenger was made by this loader and is destroyed once.
            unsafe { loader.destroy_debug_utils_messenger(messenger, None) };
        }
        // SAFETY: `Device` holds the instance and is gone; nothing made from it is left.
        unsafe { self.raw.destroy_instance(None) };
    }
}

fn create(entry: &ash::Entry, validate: bool, extensions: &[&CStr]) -> Result<ash::Instance> {
    let application = vk::ApplicationInfo::default()
        .application_name(c"amas")
        .engine_name(c"amas")
        .api_version(vk::API_VERSION_1_2);
    let layers = [VALIDATION_LAYER.as_ptr()];
    let extensions: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
    let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
    let mut info =
        vk::InstanceCreateInfo::default().application_info(&application).enabled_extension_names(&extensions);
    if validate {
        info = info.enabled_layer_names(&layers).push_next(&mut features);
    }
    // SAFETY: every pointer in `info` outlives the call; layers and extensions were found to exist.
    unsafe { entry.create_instance(&info, None) }.map_err(|result| Error::NoDevice {
        cause: format!("vkCreateInstance: {result:?}"),
        remedy: "install a Vulkan 1.2 driver, such as mesa-vulkan-drivers".into(),
    })
}

fn available_extensions(entry: &ash::Entry) -> Result<Vec<vk::ExtensionProperties>> {
    // SAFETY: no layer name is passed; the loader fills an array that ash owns.
    unsafe { entry.enumerate_instance_extension_properties(None) }
        .called("vkEnumerateInstanceExtensionProperties")
}

/// Whether an extension is among those found.
pub(super) fn has(found: &[vk::ExtensionProperties], name: &CStr) -> bool {
    found.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name))
}

fn missing_extension(name: &CStr) -> Error {
    Error::NoDevice {
        cause: format!("no Vulkan driver of the machine has {}", name.to_string_lossy()),
        remedy: "update the driver, or install mesa-vulkan-drivers".into(),
    }
}

fn require_validation(entry: &ash::Entry) -> Result<()> {
    // SAFETY: the loader fills an array that ash owns.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .called("vkEnumerateInstanceLayerProperties")?;
    if layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER)) {
        return Ok(());
    }
    Err(Error::usage(
        "--validate needs the Vulkan validation layers, and they are not installed",
        "run ./setup, or install vulkan-validationlayers",
    ))
}

/// Called by the layers, on any thread.
// SAFETY: the layers pass valid pointers for the duration of the call, and `user` is the log given at creation.
unsafe extern "system" fn on_message(
    _: vk::DebugUtilsMessageSeverityFlagsEXT,
    _: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: see above.
    let log = unsafe { &*user.cast::<ValidationLog>() };
    // SAFETY: see above; `p_message` is a terminated string.
    let text: *const c_char = unsafe { (*data).p_message };
    // SAFETY: see above.
    let text = unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned();
    log.push(text);
    vk::FALSE
}
