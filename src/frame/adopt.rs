//! Small changes of the frame's scene.

use super::Frame;
use crate::error::Result;
use crate::gpu_scene::{Edit, GpuScene};
use crate::scene::Scene;
use std::sync::Arc;

impl Frame {
    /// The scene on the device.
    #[must_use]
    pub fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// As [`GpuScene::adopt`], where nobody else has the frame's scene; `false` where somebody has.
    ///
    /// # Errors
    /// As [`GpuScene::adopt`].
    pub fn adopt(&mut self, scene: &Scene, edit: Edit) -> Result<bool> {
        let Some(gpu) = Arc::get_mut(&mut self.scene) else {
            return Ok(false);
        };
        if !gpu.adopt(&self.device, scene, edit)? {
            return Ok(false);
        }
        if let (Edit::Material(_), Some(resolve)) = (edit, &self.resolve) {
            resolve.set_materials(&gpu.records)?;
        }
        Ok(true)
    }
}
