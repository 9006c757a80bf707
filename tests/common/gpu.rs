//! Devices whose validation layers must stay silent.

use std::ops::Deref;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use amas::Gpu;
use amas::gpu::Options;

/// Devices that no test uses now. They are opened together and never closed: in the layers' table of devices whatever looks
/// one up races with whoever adds or removes one (KhronosGroup/Vulkan-ValidationLayers, issue 4391), which now and then
/// ended a suite whose tests each opened their own.
static IDLE: OnceLock<Mutex<Vec<Arc<Gpu>>>> = OnceLock::new();

/// A device of a test's own, with validation and synchronisation checks on. Dropping it fails the test if the layers
/// said anything since it was opened. Messages belong to the device, so tests that run side by side cannot blame one another.
pub(crate) struct CheckedGpu {
    gpu: Arc<Gpu>,
    /// Messages of tests before.
    before: usize,
}

impl CheckedGpu {
    /// Opens the device that `AMAS_DEVICE` names, else the best one. A machine without one fails the test.
    pub(crate) fn open() -> Self {
        let idle = IDLE.get_or_init(|| Mutex::new(several()));
        let gpu = idle.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_else(one);
        let before = messages(&gpu).len();
        Self { gpu, before }
    }

    /// A device of the test's own, with ray queries or without.
    pub(crate) fn open_with(ray_queries: bool) -> Self {
        let gpu = Gpu::open(&asked(Some(ray_queries))).unwrap();
        Self { gpu, before: 0 }
    }

    /// Drops it where the reader should see that it is checked.
    pub(crate) fn finish(self) {}
}

/// Two for each test that runs at a time: some hold a second one.
fn several() -> Vec<Arc<Gpu>> {
    let tests = std::thread::available_parallelism().map_or(1, usize::from);
    let gpus: Vec<_> = (0..2 * tests).map(|_| one()).collect();
    let info = gpus[0].info();
    eprintln!("{}, {}, Vulkan {}", info.name, info.driver, info.api);
    gpus
}

fn one() -> Arc<Gpu> {
    Gpu::open(&asked(None)).unwrap_or_else(|error| panic!("this test needs a Vulkan device: {error}"))
}

/// The device that `AMAS_DEVICE` names, with ray queries as `AMAS_RAY_QUERIES` says, unless the test says it.
fn asked(ray_queries: Option<bool>) -> Options {
    let [device, queries] = ["AMAS_DEVICE", "AMAS_RAY_QUERIES"].map(|name| std::env::var(name).ok());
    let ray_queries = ray_queries.or_else(|| queries?.parse().ok());
    Options { device, validate: true, ray_queries }
}

fn messages(gpu: &Gpu) -> Vec<String> {
    gpu.validation_messages().unwrap_or_else(|| panic!("validation is off"))
}

impl Deref for CheckedGpu {
    type Target = Arc<Gpu>;

    fn deref(&self) -> &Arc<Gpu> {
        &self.gpu
    }
}

impl Drop for CheckedGpu {
    fn drop(&mut self) {
        let messages = messages(&self.gpu).split_off(self.before);
        if let Some(idle) = IDLE.get() {
            idle.lock().unwrap_or_else(PoisonError::into_inner).push(self.gpu.clone());
        }
        // A second panic would abort and hide the first one's message.
        if !std::thread::panicking() {
            assert!(messages.is_empty(), "{} validation messages:\n{}", messages.len(), messages.join("\n"));
        }
    }
}
