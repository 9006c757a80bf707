//! What of the BSDFs a scene has, for shaders that meet all of it in one dispatch.

use super::Variant;
use crate::scene::Parameter;
use crate::shared;

/// Constants that are true of the whole where they are of any surface.
const ANY: [u32; 6] = [
    shared::SPEC_ANISOTROPIC,
    shared::SPEC_ROUGH_MATTE,
    shared::SPEC_LOBE_SHEEN,
    shared::SPEC_LOBE_CLEARCOAT,
    shared::SPEC_LOBE_SUBSURFACE,
    shared::SPEC_LOBE_METALLIC,
];

/// Specialisation constants of `glsl/lib/bsdf/mixed.glsl` and `glsl/bind/hit.glsl`.
pub(super) fn models(of_material: &[Variant]) -> Vec<(u32, u32)> {
    let values = |id| {
        let all = of_material.iter().flat_map(|variant| variant.specialization.values());
        all.filter(move |&&(other, _)| other == id).map(|&(_, value)| value)
    };
    let models = values(shared::SPEC_MODEL).fold(0, |all, model| all | 1 << model);
    let normal_map = values(shared::SPEC_SLOT + Parameter::Normal as u32).next().is_some();
    let any = ANY.map(|id| (id, values(id).fold(0, |all, value| all | value)));
    let of_all = [(shared::SPEC_BSDF_MODELS, models), (shared::SPEC_HIT_NORMAL_MAPS, u32::from(normal_map))];
    of_all.into_iter().chain(any).collect()
}
