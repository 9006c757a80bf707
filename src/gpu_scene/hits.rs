//! What the nearest hit of a ray is found and shaded by, on the device: of scenes with indirect light only.

mod materials;
mod surfaces;
mod texels;

use crate::bvh::{Bvh, Texel};
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Format, Image, ImageDescription, Use};
use crate::scene::Scene;
use crate::shared::{self, BVH_WIDTH_LOG2};
use materials::{Materials, is_anisotropic};
use std::sync::Arc;
use surfaces::Surfaces;
use texels::Heap;

/// The textures that `glsl/bind/hit.glsl` reads.
pub struct Hits {
    /// Specialisation constants of what calls `hit_surface`, beside those of the occluders.
    pub specialization: Vec<(u32, u32)>,
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
        texels.resize(texels.len().next_multiple_of(1 << BVH_WIDTH_LOG2).max(1 << BVH_WIDTH_LOG2), [0; 4]);
        let materials = Materials::new(scene, heap);
        let hits = Self {
            specialization: vec![(
                shared::SPEC_ANISOTROPIC,
                u32::from(scene.materials.iter().any(is_anisotropic)),
            )],
            texels: image(device, "hits", 1 << BVH_WIDTH_LOG2, texels.len())?,
            records: image(device, "materials of hits", materials::WIDTH, materials.texels.len())?,
            materials: Some(materials),
        };
        hits.texels.upload(&[&texels], Use::Texture)?;
        hits.upload_materials()?;
        Ok(hits)
    }

    /// Of a scene where nothing asks: a texel each.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn none(device: &Arc<Device>) -> Result<Self> {
        let [texels, records] = [(); 2].map(|()| image(device, "no hits", 1, 1));
        let hits = Self { specialization: Vec::new(), materials: None, texels: texels?, records: records? };
        for image in [&hits.texels, &hits.records] {
            image.upload(&[&[[0_u32; 4]][..]], Use::Texture)?;
        }
        Ok(hits)
    }

    /// Takes a material's constants over from the scene.
    pub(super) fn adopt(&mut self, scene: &Scene, material: usize) -> Result<()> {
        match &mut self.materials {
            None => Ok(()),
            Some(materials) => {
                materials.set(scene, material);
                self.upload_materials()
            }
        }
    }

    fn upload_materials(&self) -> Result<()> {
        let Some(materials) = &self.materials else { return Ok(()) };
        self.records.upload(&[&materials.texels], Use::Texture)
    }

    /// Puts them into a scene's set.
    pub fn bind(&self, scene: DescriptorSet<'_>) {
        scene.image(shared::scene::SCENE_HITS, &self.texels, Use::Texture);
        scene.image(shared::scene::SCENE_HIT_MATERIALS, &self.records, Use::Texture);
    }
}

fn image(device: &Arc<Device>, name: &str, width: usize, texels: usize) -> Result<Image> {
    let size = [width as u32, (texels / width) as u32];
    let uses = &[Use::TransferWrite, Use::Texture];
    let format = Format::R32G32B32A32_UINT;
    Image::new(device, &ImageDescription { name, format, size, layers: None, mips: 1, uses })
}
