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

/// The pipelines that somebody holds.
#[derive(Default)]
pub(in super::super) struct Compiled(Mutex<HashMap<Key, Weak<Raw>>>);

impl Compiled {
    /// The pipeline of that key; compiled, where there is none.
    pub(super) fn get(&self, key: Key, compile: impl FnOnce() -> Result<Raw>) -> Result<Arc<Raw>> {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(raw) = known().get(&key).and_then(Weak::upgrade) {
            return Ok(raw);
        }
        // Unlocked: another thread may compile, too. Where it is the same pipeline, each has its own.
        let raw = Arc::new(compile()?);
        let mut known = known();
        known.retain(|_, raw| raw.strong_count() > 0);
        known.insert(key, Arc::downgrade(&raw));
        Ok(raw)
    }
}
