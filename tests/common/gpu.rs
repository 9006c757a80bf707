//! A device whose validation layers must stay silent.

use std::ops::Deref;
use std::sync::{Arc, Once};

use amas::Gpu;
use amas::gpu::Options;

/// A device of a test's own, with validation and synchronisation checks on. Dropping it fails the test if the layers
/// said anything. Messages belong to the device, so tests that run side by side cannot blame one another.
pub(crate) struct CheckedGpu(Arc<Gpu>);

impl CheckedGpu {
    /// Opens the device that `AMAS_DEVICE` names, else the best one. A machine without one fails the test.
    pub(crate) fn open() -> Self {
        static ANNOUNCED: Once = Once::new();
        let options = Options { device: std::env::var("AMAS_DEVICE").ok(), validate: true };
        let gpu =
            Gpu::open(&options).unwrap_or_else(|error| panic!("this test needs a Vulkan device: {error}"));
        let info = gpu.info();
        ANNOUNCED.call_once(|| eprintln!("{}, {}, Vulkan {}", info.name, info.driver, info.api));
        Self(gpu)
    }

    /// Drops it where the reader should see that it is checked.
    pub(crate) fn finish(self) {}

    fn require_silence(&self) {
        let messages = self.0.validation_messages();
        let messages = messages.unwrap_or_else(|| panic!("validation is off"));
        assert!(messages.is_empty(), "{} validation messages:\n{}", messages.len(), messages.join("\n"));
    }
}

impl Deref for CheckedGpu {
    type Target = Arc<Gpu>;

    fn deref(&self) -> &Arc<Gpu> {
        &self.0
    }
}

impl Drop for CheckedGpu {
    fn drop(&mut self) {
        // A second panic would abort and hide the first one's message.
        if !std::thread::panicking() {
            self.require_silence();
        }
    }
}
