//! Small changes of a scene that is on the device: only what they touch is uploaded again.

use super::lights::{Moving, placed};
use super::{GpuScene, record, variant};
use crate::area_lights::AreaLights;
use crate::error::Result;
use crate::gpu::{Device, Use};
use crate::light_tree::{LightTree, median_range};
use crate::scene::Scene;
use std::sync::Arc;

/// What changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Edit {
    /// Constants of the material of that index.
    Material(usize),
    /// Point lights: places, intensities, ranges.
    PointLights,
    /// Radiance of area lights.
    AreaLights,
}

impl GpuScene {
    /// Takes an edit over from the scene; `false` where pipelines or sizes would change, so that the scene has to be uploaded
    /// anew.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn adopt(&mut self, device: &Arc<Device>, scene: &Scene, edit: Edit) -> Result<bool> {
        match edit {
            Edit::Material(index) => self.adopt_material(scene, index),
            Edit::PointLights => self.adopt_point_lights(device, scene),
            Edit::AreaLights => self.area.adopt(&AreaLights::new(scene, self.origin)?),
        }
    }

    fn adopt_material(&mut self, scene: &Scene, index: usize) -> Result<bool> {
        let material = &scene.materials[index];
        if variant(material, &self.tables)? != self.of_material[index] {
            return Ok(false);
        }
        self.records[index] = record(material);
        self.record_buffer.write_from(index, &self.records[index..=index])?;
        self.hits.adopt(scene, index)?;
        Ok(true)
    }

    fn adopt_point_lights(&mut self, device: &Arc<Device>, scene: &Scene) -> Result<bool> {
        if !self.take_lights(device, placed(scene, self.origin))? {
            return Ok(false);
        }
        self.moving = Moving::new(device, scene, self.origin)?;
        Ok(true)
    }

    /// Takes lights over that stand, about the scene's origin, in the order that they have; `false` where they are more or fewer.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn take_lights(&mut self, device: &Arc<Device>, lights: LightTree) -> Result<bool> {
        let shape = |tree: &LightTree| (tree.lights.len(), tree.ranged, tree.nodes.len(), tree.moments.len());
        if shape(&lights) != shape(&self.lights) {
            return Ok(false);
        }
        self.light_images.upload(device, &lights, Use::StorageRead)?;
        self.median_range = median_range(&lights.lights);
        self.lights = lights;
        Ok(true)
    }
}
