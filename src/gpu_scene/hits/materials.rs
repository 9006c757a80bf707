//! Materials' records, in a texture of their own, so that an edit of one uploads little.

use super::texels::{Heap, Place};
use crate::bvh::Texel;
use crate::gpu_scene::is_anisotropic;
use crate::scene::{Material, Parameter, Scene};
use crate::shared::{
    HIT_MATERIAL_TEXELS, HIT_SQUARED_ROUGHNESS, HIT_TWO_SIDED, HitMaterial, HitTexture, MATERIAL_RECORD_LOG2,
    MATERIAL_TEXTURES, MATERIALS_PER_ROW_LOG2,
};

/// Texels from one record to the next.
const STRIDE: usize = 1 << MATERIAL_RECORD_LOG2;
const _: () = assert!(HIT_MATERIAL_TEXELS + MATERIAL_TEXTURES <= 1 << MATERIAL_RECORD_LOG2);
/// Texels across.
pub(super) const WIDTH_LOG2: u32 = MATERIAL_RECORD_LOG2 + MATERIALS_PER_ROW_LOG2;

/// Parameters that a hit reads, by which textures count: not masks, which lie beside the tree.
pub(super) const READ: usize = Parameter::Normal as usize + 1;

pub(super) struct Materials {
    pub(super) texels: Vec<Texel>,
    heap: Heap,
}

impl Materials {
    pub(super) fn new(scene: &Scene, heap: Heap) -> Self {
        let mut materials = Self { texels: vec![[0; 4]; scene.materials.len() * STRIDE], heap };
        (0..scene.materials.len()).for_each(|index| materials.set(scene, index));
        materials
    }

    /// Takes a material over from the scene, whose textures are those that the heap was made of.
    pub(super) fn set(&mut self, scene: &Scene, index: usize) {
        let material = &scene.materials[index];
        let textures = textures(material, &self.heap);
        let record = record(material, textures.len() as u32);
        let texels = &mut self.texels[index * STRIDE..][..STRIDE];
        let (constants, slots) = texels.split_at_mut(HIT_MATERIAL_TEXELS as usize);
        constants.copy_from_slice(bytemuck::cast_slice(std::slice::from_ref(&record)));
        slots[..textures.len()].copy_from_slice(bytemuck::cast_slice(&textures));
    }
}

/// Textures of more parameters than a material may have are refused where pipelines are chosen.
fn textures(material: &Material, heap: &Heap) -> Vec<HitTexture> {
    let round = !is_anisotropic(material);
    let values = (0..).zip(&material.parameters[..READ]);
    let values = values.filter(|&(parameter, _)| !(round && parameter == Parameter::Aspect as u32));
    let textured = values.filter_map(|(parameter, value)| Some((parameter, heap.place(value.texture?)?)));
    let textured = textured.take(MATERIAL_TEXTURES as usize);
    textured
        .map(|(parameter, Place { first, size: [width, height] })| HitTexture {
            parameter,
            first,
            width,
            height,
        })
        .collect()
}

fn record(material: &Material, textures: u32) -> HitMaterial {
    let color = |parameter| material.value(parameter).constant;
    let scalar = |parameter| color(parameter)[0];
    let flag = |flag, set| if set { flag } else { 0 };
    HitMaterial {
        color: color(Parameter::Color),
        kind: material.model as u32
            | flag(HIT_SQUARED_ROUGHNESS, material.squared_roughness)
            | flag(HIT_TWO_SIDED, material.two_sided),
        specular: color(Parameter::Specular),
        textures,
        roughness: scalar(Parameter::Roughness),
        aspect: if is_anisotropic(material) { scalar(Parameter::Aspect) } else { 1.0 },
        sigma: scalar(Parameter::Sigma),
        eta: scalar(Parameter::Eta),
        metallic: scalar(Parameter::Metallic),
        specular_tint: scalar(Parameter::SpecularTint),
        sheen: scalar(Parameter::Sheen),
        sheen_tint: scalar(Parameter::SheenTint),
        clearcoat: scalar(Parameter::Clearcoat),
        clearcoat_gloss: scalar(Parameter::ClearcoatGloss),
        subsurface: scalar(Parameter::Subsurface),
        spare: 0,
    }
}
