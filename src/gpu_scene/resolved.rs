//! What a compute shader can shade from the surface image alone, and by which pipeline.

use super::Variant;
use crate::gpu::Specialization;
use crate::scene::Parameter;
use crate::scene::material::PARAMETER_COUNT;
use crate::shared;
use std::ops::Range;

/// Constants of a variant that tell of area lights alone.
const OF_AREA_LIGHTS: [u32; 4] =
    [shared::SPEC_LTC_SPECULAR, shared::SPEC_LTC_COAT, shared::SPEC_CLOSED_FORM, shared::SPEC_LTC_METALLIC];
const SLOTS: Range<u32> = shared::SPEC_SLOT..shared::SPEC_SLOT + PARAMETER_COUNT as u32;
const MASK: u32 = shared::SPEC_SLOT + Parameter::Mask as u32;

/// The variants that compute shades. A texture needs its coordinates and their derivatives, an anisotropic lobe its
/// tangent, and neither is in the surface image.
#[derive(Clone, Debug, Default)]
pub struct Resolved {
    /// What their pipelines are specialised by.
    pub specializations: Vec<Specialization>,
    // By variant of the scene; `None`: left to fragment shaders.
    of_variant: Vec<Option<u32>>,
}

impl Resolved {
    /// Sorts the scene's variants out. What differs in culling and masks alone is shaded alike.
    pub(super) fn new(variants: &[Variant], materials: usize) -> Self {
        let mut all = Self::default();
        let nameable = materials <= 1 << shared::SURFACE_MATERIAL_BITS;
        for variant in variants {
            let shading = shading(variant).filter(|_| nameable);
            let index = shading.and_then(|shading| all.index(shading));
            all.of_variant.push(index);
        }
        all
    }

    fn index(&mut self, shading: Specialization) -> Option<u32> {
        let known = self.specializations.iter().position(|other| *other == shading);
        let index = known.unwrap_or(self.specializations.len());
        if known.is_none() && index < shared::RESOLVE_VARIANTS as usize {
            self.specializations.push(shading);
        }
        (index < self.specializations.len()).then_some(index as u32)
    }

    /// Whether compute shades draws of a variant.
    #[must_use]
    pub fn has(&self, variant: usize) -> bool {
        self.of_variant[variant].is_some()
    }

    /// Whether it shades all of them.
    #[must_use]
    pub fn has_all(&self) -> bool {
        self.of_variant.iter().all(Option::is_some)
    }

    /// The last word of a draw's surfaces.
    #[must_use]
    pub fn word(&self, variant: usize, material: u32) -> u32 {
        self.of_variant[variant].map_or(0, |index| (index + 1) << shared::SURFACE_MATERIAL_BITS) | material
    }
}

fn shading(variant: &Variant) -> Option<Specialization> {
    let values = variant.specialization.values().iter();
    let textured = |&&(id, _): &&(u32, u32)| SLOTS.contains(&id) && id != MASK;
    let oriented = |&&(id, value): &&(u32, u32)| id == shared::SPEC_ANISOTROPIC && value != 0;
    if values.clone().any(|value| textured(&value) || oriented(&value)) {
        return None;
    }
    let kept = values.filter(|(id, _)| *id != MASK && !OF_AREA_LIGHTS.contains(id));
    Some(Specialization::default().with_all(&kept.copied().collect::<Vec<_>>()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variant(constants: &[(u32, u32)]) -> Variant {
        let specialization = Specialization::default().with_all(constants);
        Variant { masked: false, both_sides: true, specialization }
    }

    #[test]
    fn masks_and_culling_make_no_difference_but_textures_and_tangents_do() {
        let [matte, plastic] = [0, 1].map(|model| (shared::SPEC_MODEL, model));
        let variants = [
            variant(&[matte]),
            Variant { masked: true, both_sides: false, ..variant(&[matte, (MASK, 0)]) },
            variant(&[plastic, (shared::SPEC_LTC_SPECULAR, 3), (shared::SPEC_ANISOTROPIC, 0)]),
            variant(&[plastic, (shared::SPEC_ANISOTROPIC, 1)]),
            variant(&[plastic, (shared::SPEC_SLOT, 0)]),
        ];
        let resolved = Resolved::new(&variants, 7);
        assert_eq!(resolved.of_variant, [Some(0), Some(0), Some(1), None, None]);
        assert_eq!(resolved.word(1, 5), 1 << 24 | 5);
        assert_eq!(resolved.word(2, 6), 2 << 24 | 6);
        assert_eq!(resolved.word(4, 6), 6, "variant 0: left to fragments");
        assert!(!resolved.has_all() && Resolved::new(&variants[..3], 7).has_all());
    }

    /// A cluster has a bit for each variant, and a surface so many bits for its material.
    #[test]
    fn what_has_no_bit_is_left_to_fragments() {
        let count = shared::RESOLVE_VARIANTS + 3;
        let variants: Vec<_> = (0..count).map(|i| variant(&[(shared::SPEC_MODEL, i)])).collect();
        let resolved = Resolved::new(&variants, 7);
        assert_eq!(resolved.specializations.len() as u32, shared::RESOLVE_VARIANTS);
        assert!(resolved.has(31) && !resolved.has(32) && !resolved.has(34));
        assert_eq!(resolved.word(31, 0), 32 << 24);
        assert!(!Resolved::new(&variants, (1 << 24) + 1).has(0));
    }
}
