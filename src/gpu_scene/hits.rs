//! What the nearest hit of a ray is found and shaded by, on the device: of scenes with indirect light only.

mod materials;
mod surfaces;
mod texels;

use crate::bvh::{Bvh, Texel};
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Image, Use};
use crate::scene::Scene;
use crate::shared::{self, BVH_WIDTH_LOG2};
use materials::Materials;
use std::sync::Arc;
use surfaces::Surfaces;
use texels::Heap;

/// The textures that `glsl/bind/hit.glsl` reads.
pub struct Hits {
    /// `None` where nothing may ask.
    materials: Option<Materials>,
    texels: Image,
    records: Image,
}

impl Hits {
    /// Uploads what `bvh`, the tree over `scene`, does not hold: orders of its nodes, surfaces, materials, textures.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short, or where the device's textures are too small: a triangle takes some
    /// ten texels of them.
    pub fn new(device: &Arc<Device>, scene: &Scene, bvh: &Bvh) -> Result<Self> {
        let mut texels: Vec<Texel> = bytemuck::cast_slice(&bvh.ordered_nodes()).to_vec();
        Surfaces::new(scene, bvh, texels.len()).append(&mut texels);
        let heap = Heap::append(scene, &mut texels);
        let materials = Materials::new(scene, heap);
        Ok(Self {
            texels: Image::of_texels(device, "hits", BVH_WIDTH_LOG2, &texels)?,
            records: Image::of_texels(device, "materials of hits", materials::WIDTH_LOG2, &materials.texels)?,
            materials: Some(materials),
        })
    }

    /// Of a scene where nothing asks: a texel each.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn none(device: &Arc<Device>) -> Result<Self> {
        let image = || Image::of_texels(device, "no hits", 0, &[]);
        Ok(Self { materials: None, texels: image()?, records: image()? })
    }

    /// Whether there is anything that could be asked.
    #[must_use]
    pub fn exist(&self) -> bool {
        self.materials.is_some()
    }

    /// Takes a material's constants over from the scene.
    pub(super) fn adopt(&mut self, scene: &Scene, material: usize) -> Result<()> {
        match &mut self.materials {
            None => Ok(()),
            Some(materials) => {
                materials.set(scene, material);
                self.records.replace_texels(&materials.texels)
            }
        }
    }

    /// Puts them into a scene's set.
    pub fn bind(&self, scene: DescriptorSet<'_>) {
        scene.image(shared::scene::SCENE_HITS, &self.texels, Use::Texture);
        scene.image(shared::scene::SCENE_HIT_MATERIALS, &self.records, Use::Texture);
    }
}
