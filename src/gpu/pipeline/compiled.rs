//! Pipelines that are in use, by all that they were made from.
//!
//! A scene that is loaded again has most of its pipelines in common with the one that it replaces, and so has a frame that is
//! made anew with other settings or with one shader changed. A driver compiles each once for as long as anything uses it.

use super::super::Shader;
use super::super::descriptor::PipelineLayout;
use super::super::device::Device;
use super::super::render_pass::Shape;
use super::{Blend, Cull, DepthTest, Specialization, Vertices};
use crate::error::Result;
use crate::shared::Binding;
use ash::vk;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// A pipeline of the driver's.
pub(in super::super) struct Raw {
    pub(in super::super) pipeline: vk::Pipeline,
    pub(super) device: Arc<Device>,
}

impl Drop for Raw {
    fn drop(&mut self) {
        // SAFETY: no work is pending outside `Device::run`.
        unsafe { self.device.raw.destroy_pipeline(self.pipeline, None) };
    }
}

/// What a pipeline is made from: two with equal keys do the same wherever either may be bound, as layouts of the same tables
/// and passes of the same shape are compatible.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct Key {
    /// Names, and the words of those that have changed since the program was built.
    shaders: Vec<(&'static str, Option<Vec<u32>>)>,
    specialization: Specialization,
    sets: Vec<&'static [Binding]>,
    /// `None` for compute.
    state: Option<State>,
}

/// What a graphics pipeline has beyond shaders.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct State {
    pub(super) vertices: Vertices,
    pub(super) depth: DepthTest,
    pub(super) blend: Option<Blend>,
    pub(super) cull: Cull,
    pub(super) pass: Arc<Shape>,
    pub(super) subpass: u32,
}

impl Key {
    pub(super) fn new(
        device: &Device,
        shaders: &[Shader],
        specialization: &Specialization,
        layout: &PipelineLayout,
        state: Option<State>,
    ) -> Self {
        Self {
            shaders: shaders.iter().map(|&shader| (shader.name, device.replaced(shader))).collect(),
            specialization: specialization.clone(),
            sets: layout.tables().collect(),
            state,
        }
    }
}

/// A pipeline, as long as somebody holds it; locked while it is compiled.
type Slot = Arc<Mutex<Weak<Raw>>>;

/// The pipelines that somebody holds.
#[derive(Default)]
pub(in super::super) struct Compiled(Mutex<HashMap<Key, Slot>>);

impl Compiled {
    /// The pipeline of that key; compiled, where there is none. Who asks for the same one meanwhile waits for it, who asks for
    /// another does not.
    pub(super) fn get(&self, key: Key, compile: impl FnOnce() -> Result<Raw>) -> Result<Arc<Raw>> {
        let slot = self.slot(key);
        let mut held = slot.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(raw) = held.upgrade() {
            return Ok(raw);
        }
        let raw = Arc::new(compile()?);
        *held = Arc::downgrade(&raw);
        Ok(raw)
    }

    /// That of a key. Others whose pipelines have gone go, too, unless a thread has them at hand.
    fn slot(&self, key: Key) -> Slot {
        let gone = |slot: &Slot| slot.lock().unwrap_or_else(PoisonError::into_inner).strong_count() == 0;
        let mut slots = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        slots.retain(|_, slot| Arc::strong_count(slot) > 1 || !gone(slot));
        slots.entry(key).or_default().clone()
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::{ComputePipeline, Options};
    use super::super::compile_compute;
    use super::*;
    use crate::gpu::shaders::PROBE_BSDF_COMP;
    use crate::shared;
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::sync::mpsc::channel;
    use std::time::Duration;

    fn open() -> (Arc<Device>, Arc<PipelineLayout>) {
        let options = Options { device: Some("llvmpipe".into()), validate: true, ray_queries: None };
        let device = Device::open(&options).unwrap();
        let layout = PipelineLayout::new(&device, &[shared::probe::BINDINGS, shared::scene::BINDINGS]);
        (device.clone(), Arc::new(layout.unwrap()))
    }

    /// Of one of the BSDFs.
    fn of(model: u32) -> Specialization {
        Specialization::default().with(shared::SPEC_MODEL, model)
    }

    fn known(device: &Device) -> usize {
        device.compiled.0.lock().unwrap().len()
    }

    #[test]
    fn equal_pipelines_are_one_until_nobody_holds_it() {
        let (device, layout) = open();
        let make = |model| ComputePipeline::new(&device, &layout, PROBE_BSDF_COMP, &of(model)).unwrap();
        let (first, second, other) = (make(0), make(0), make(1));
        assert!(Arc::ptr_eq(&first.raw, &second.raw), "the same, compiled twice");
        assert!(!Arc::ptr_eq(&first.raw, &other.raw), "another specialisation");
        // Layouts of the same tables are compatible.
        let tables = [shared::probe::BINDINGS, shared::scene::BINDINGS];
        let again = Arc::new(PipelineLayout::new(&device, &tables).unwrap());
        let third = ComputePipeline::new(&device, &again, PROBE_BSDF_COMP, &of(0)).unwrap();
        assert!(Arc::ptr_eq(&first.raw, &third.raw), "the same under a layout of the same tables");
        // Other words under the same name: what hot reload does.
        let words = PROBE_BSDF_COMP.words(false);
        device.replace_shaders([((PROBE_BSDF_COMP.name, false), words)].into());
        assert!(!Arc::ptr_eq(&first.raw, &make(0).raw), "a shader that has changed");
        device.replace_shaders(HashMap::new());
        assert!(Arc::ptr_eq(&first.raw, &make(0).raw), "the shader as it was");

        let held = Arc::downgrade(&first.raw);
        drop((first, second));
        assert_eq!(held.strong_count(), 1, "the third has it still");
        drop(third);
        assert!(held.upgrade().is_none(), "nobody holds it, and it is there");
        let remade = make(0);
        assert_eq!(known(&device), 2, "those that are held, and no trace of others");
        drop((remade, other, layout, again));
        device.require_silence().unwrap();
    }

    #[test]
    fn threads_that_ask_at_once_compile_once() {
        const THREADS: usize = 4;
        let (device, layout) = open();
        let (calls, start) = (AtomicUsize::new(0), Barrier::new(THREADS));
        let get = || {
            let key = Key::new(&device, &[PROBE_BSDF_COMP], &of(0), &layout, None);
            start.wait();
            device.compiled.get(key, || {
                calls.fetch_add(1, Ordering::Relaxed);
                // Long enough for the others to ask.
                std::thread::sleep(Duration::from_millis(100));
                compile_compute(&device, &layout, PROBE_BSDF_COMP, &of(0))
            })
        };
        let made: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..THREADS).map(|_| scope.spawn(get)).collect();
            threads.into_iter().map(|thread| thread.join().unwrap().unwrap()).collect()
        });
        assert_eq!(calls.into_inner(), 1);
        assert!(made.iter().all(|raw| Arc::ptr_eq(raw, &made[0])));
    }

    /// One that is being compiled keeps nobody from another; one that fails is tried again.
    #[test]
    fn pipelines_do_not_wait_for_one_another() {
        let (device, layout) = open();
        let key = |model| Key::new(&device, &[PROBE_BSDF_COMP], &of(model), &layout, None);
        let compile = |model| compile_compute(&device, &layout, PROBE_BSDF_COMP, &of(model));
        let failed = device.compiled.get(key(0), || Err(crate::error::Error::usage("no", "none")));
        assert!(failed.is_err());
        let (done, waits) = channel();
        let first = device.compiled.get(key(0), || {
            std::thread::scope(|scope| {
                scope.spawn(|| done.send(device.compiled.get(key(1), || compile(1)).is_ok()));
                let other = waits.recv_timeout(Duration::from_secs(30));
                assert_eq!(other, Ok(true), "waited in vain for the other pipeline");
            });
            compile(0)
        });
        assert!(first.is_ok());
    }
}
