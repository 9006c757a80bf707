//! The tables of linearly transformed cosines that the scene's lobes use, on the device.

use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Format, Image, ImageDescription, Specialization, Use};
use crate::ltc::{self, Layer, LayerTable};
use crate::scene::{Material, Model, Parameter, Scene};
use crate::shared;
use std::sync::Arc;

/// The tables; a scene without area lights has none.
pub(super) struct Tables {
    layers: Vec<Layer>,
    image: Image,
    light_error: f32,
}

impl Tables {
    /// Uploads what the scene's materials need.
    ///
    /// # Errors
    /// [`crate::Error::Input`] for damaged tables, [`crate::Error::Vulkan`] where memory is short.
    pub(super) fn new(device: &Arc<Device>, scene: &Scene) -> Result<Self> {
        let mut layers: Vec<_> =
            scene.materials.iter().flat_map(|m| [specular(m), coat(m)]).flatten().collect();
        layers.sort_unstable();
        layers.dedup();
        if scene.area_lights.is_empty() {
            layers.clear();
        }
        let mut texels = Vec::new();
        for &layer in &layers {
            let table = ltc::tables()?.layer(layer);
            texels.extend(padded(table, &table.shape));
            texels.extend(padded(table, &table.moments));
        }
        let size = if layers.is_empty() { [1, 1] } else { [shared::LTC_COLUMNS, shared::LTC_ROWS + 1] };
        if layers.is_empty() {
            texels.push([0.0; 4]);
        }
        let image = Image::new(
            device,
            &ImageDescription {
                name: "transformed cosines",
                format: Format::R32G32B32A32_SFLOAT,
                size,
                layers: Some((2 * layers.len() as u32).max(1)),
                mips: 1,
                uses: &[Use::TransferWrite, Use::Texture],
            },
        )?;
        image.upload(&[&texels], Use::Texture)?;
        Ok(Self { layers, image, light_error: scene.render.light_error })
    }

    /// Puts them where the shaders look.
    pub(super) fn bind(&self, set: DescriptorSet<'_>) {
        set.image(shared::scene::SCENE_LTC, &self.image, Use::Texture);
    }

    /// Which of them a material's lobes use, and how.
    ///
    /// # Errors
    /// [`crate::Error::Input`] for damaged tables.
    pub(super) fn specialize(
        &self,
        material: &Material,
        specialization: Specialization,
    ) -> Result<Specialization> {
        let index = |layer: Option<Layer>| {
            let at = layer.and_then(|layer| self.layers.binary_search(&layer).ok());
            at.unwrap_or(0) as u32
        };
        let metallic = specular(material) == Some(Layer::PrincipledSpecular);
        Ok(specialization
            .with(shared::SPEC_LTC_SPECULAR, index(specular(material)))
            .with(shared::SPEC_LTC_COAT, index(coat(material)))
            .with(shared::SPEC_LTC_METALLIC, u32::from(metallic))
            .with(shared::SPEC_CLOSED_FORM, u32::from(self.closed_form(material)?)))
    }

    /// Whether the lobe's transformed cosine is within the error that lights may have somewhere: it fits best from above.
    fn closed_form(&self, material: &Material) -> Result<bool> {
        let roughness = material.value(Parameter::Roughness);
        let aspect = material.value(Parameter::Aspect);
        let isotropic = aspect.texture.is_none() && (aspect.constant[0] - 1.0).abs() < 1e-6;
        let Some(layer) = specular(material).filter(|layer| isotropic && self.layers.contains(layer)) else {
            return Ok(false);
        };
        let constant = f64::from(roughness.constant[0]);
        let r = if material.squared_roughness { constant } else { constant.sqrt() };
        let variation = ltc::tables()?.lookup(layer, r, 1.0).moments[3];
        Ok(roughness.texture.is_some() || variation < f64::from(self.light_error))
    }
}

/// The lobe whose shape is nearest to that of the material's microfacets.
fn specular(material: &Material) -> Option<Layer> {
    let metallic = material.value(Parameter::Metallic);
    match material.model {
        Model::Matte => None,
        Model::Plastic => Some(Layer::Plastic),
        Model::Metal => Some(Layer::Metal),
        Model::Substrate => Some(Layer::SubstrateDielectric),
        Model::Principled if metallic.texture.is_some() || metallic.constant[0] > 0.5 => {
            Some(Layer::PrincipledSpecular)
        }
        Model::Principled => Some(Layer::PrincipledDielectric),
    }
}

fn coat(material: &Material) -> Option<Layer> {
    let weight = material.value(Parameter::Clearcoat);
    let coated = weight.texture.is_some() || weight.constant[0] > 0.0;
    (material.model == Model::Principled && coated).then_some(Layer::Clearcoat)
}

/// A table in a layer of its own size or larger, and behind it a row that says where it ends and what its axis spans.
fn padded(table: &LayerTable, texels: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let width = shared::LTC_COLUMNS as usize;
    let [columns, rows] = table.size.map(|side| side as usize);
    let mut layer = vec![[0.0; 4]; width * (shared::LTC_ROWS as usize + 1)];
    for (to, from) in layer.chunks_exact_mut(width).zip(texels.chunks_exact(columns)) {
        to[..columns].copy_from_slice(from);
    }
    let [first, last] = table.axis;
    layer[width * shared::LTC_ROWS as usize] = [(columns - 1) as f32, (rows - 1) as f32, first, last];
    layer
}
