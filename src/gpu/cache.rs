//! Compiled pipelines, kept on disk from one start to the next.

use super::Called;
use crate::error::Result;
use crate::image::write_atomically;
use ash::vk;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The driver's cache, and the file it came from.
pub(super) struct Cache {
    /// Null where there is none.
    pub(super) raw: vk::PipelineCache,
    file: Option<PathBuf>,
}

impl Cache {
    /// Nothing is kept.
    pub(super) fn none() -> Self {
        Self { raw: vk::PipelineCache::null(), file: None }
    }

    /// Kept in a folder, in a file of the device's and the driver's own: another driver's pipelines would not be read anyway.
    pub(super) fn below(
        folder: &Path,
        raw: &ash::Device,
        properties: &vk::PhysicalDeviceProperties,
    ) -> Result<Self> {
        let uuid: String = properties.pipeline_cache_uuid.iter().map(|byte| format!("{byte:02x}")).collect();
        let name = format!("pipelines-{:04x}-{:04x}-{uuid}", properties.vendor_id, properties.device_id);
        let file = folder.join(name);
        // The driver looks at the header, and begins anew where it is not its own.
        let kept = std::fs::read(&file).unwrap_or_default();
        let info = vk::PipelineCacheCreateInfo::default().initial_data(&kept);
        // SAFETY: the bytes are ones that a driver gave out for this file, which is only ever replaced as a whole.
        let raw = unsafe { raw.create_pipeline_cache(&info, None) }.called("vkCreatePipelineCache")?;
        Ok(Self { raw, file: Some(file) })
    }

    /// Writes what the driver has, all or nothing, unless the file holds it already.
    pub(super) fn save(&self, raw: &ash::Device) {
        let Some(file) = &self.file else { return };
        // SAFETY: the cache is alive.
        let Ok(data) = (unsafe { raw.get_pipeline_cache_data(self.raw) }) else { return };
        if std::fs::read(file).is_ok_and(|kept| kept == data) {
            return;
        }
        // The next start is slower where this fails; that is no reason to fail this one.
        if let Some(folder) = file.parent() {
            let _ = std::fs::create_dir_all(folder);
        }
        let _ = write_atomically(file, |file| file.write_all(&data));
    }

    pub(super) fn destroy(&self, raw: &ash::Device) {
        // SAFETY: no pipeline is being made any more; a null cache is allowed.
        unsafe { raw.destroy_pipeline_cache(self.raw, None) };
    }
}
