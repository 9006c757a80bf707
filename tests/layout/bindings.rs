//! Descriptors against the tables of `shared`, and specialisation constants by name.

use std::collections::{BTreeMap, BTreeSet};

use amas::scene::Parameter;
use amas::shared::{self, Binding, BindingKind};

use crate::spirv::{Module, Type, Variable, class, decoration};
use crate::{constants, modules};

#[test]
fn descriptors_are_those_of_the_tables() {
    let mut used = BTreeSet::new();
    for (shader, module) in modules() {
        for variable in &module.variables {
            let Some(set) = module.decoration(variable.id, decoration::DESCRIPTOR_SET) else {
                continue;
            };
            let slot = module.decoration(variable.id, decoration::BINDING).unwrap();
            let context = format!("{}: set {set}, binding {slot}", shader.name);
            let (table, bindings) =
                table(shader.name, set).unwrap_or_else(|| panic!("{context}: no such set"));
            let found = bindings.iter().find(|binding| binding.binding == slot);
            let want = found.unwrap_or_else(|| panic!("{context}: not in shared::{table}"));
            let (kind, count) = described(&module, variable);
            assert_eq!((kind, count), (Some(want.kind), want.count), "{context}: kind and count");
            used.insert((table, slot));
        }
    }
    let tables =
        ["frame", "scene", "material", "resolve", "pairs", "gather", "order", "overlay", "probe"].into_iter();
    let all: BTreeSet<_> = tables
        .flat_map(|name| bindings_of(name).iter().map(move |binding| (name, binding.binding)))
        .collect();
    assert_eq!(used, all, "bindings that shaders use against bindings declared");
}

fn bindings_of(table: &str) -> &'static [Binding] {
    match table {
        "frame" => shared::frame::BINDINGS,
        "scene" => shared::scene::BINDINGS,
        "material" => shared::material::BINDINGS,
        "resolve" => shared::resolve::BINDINGS,
        "pairs" => shared::pairs::BINDINGS,
        "gather" => shared::gather::BINDINGS,
        "order" => shared::order::BINDINGS,
        "overlay" => shared::overlay::BINDINGS,
        _ => shared::probe::BINDINGS,
    }
}

/// The probes, the order of points and the window's overlay have sets of their own, in the place of the frame's; the resolve, the
/// accounting and the gathering, in that of a material's.
fn table(shader: &str, set: u32) -> Option<(&'static str, &'static [Binding])> {
    let name = match set {
        shared::overlay::SET if shader.starts_with("overlay/") => "overlay",
        shared::probe::SET if shader.starts_with("probe/") => "probe",
        shared::order::SET if shader.starts_with("order/") => "order",
        shared::frame::SET => "frame",
        shared::scene::SET => "scene",
        shared::resolve::SET if shader.starts_with("resolve/") => "resolve",
        shared::pairs::SET if ["cluster/pairs.comp", "cluster/floors.comp"].contains(&shader) => "pairs",
        shared::gather::SET if shader == "gather/gather.comp" => "gather",
        shared::material::SET => "material",
        _ => return None,
    };
    Some((name, bindings_of(name)))
}

fn described(module: &Module, variable: &Variable) -> (Option<BindingKind>, u32) {
    const SUBPASS_DATA: u32 = 6;
    let (of, count) = module.pointee(variable.pointer);
    let block = module.decoration(of, decoration::BLOCK).is_some();
    let kind = match (variable.class, module.typed(of)) {
        (class::UNIFORM, Type::Struct { .. }) if block => Some(BindingKind::Uniform),
        (class::STORAGE_BUFFER, Type::Struct { .. }) if block => Some(BindingKind::Storage),
        (class::UNIFORM_CONSTANT, Type::RayTree) => Some(BindingKind::RayTree),
        (class::UNIFORM_CONSTANT, Type::SampledImage) => Some(BindingKind::Combined),
        (class::UNIFORM_CONSTANT, Type::Image { dim: SUBPASS_DATA, .. }) => Some(BindingKind::Input),
        (class::UNIFORM_CONSTANT, Type::Image { sampled: 1, .. }) => Some(BindingKind::Sampled),
        (class::UNIFORM_CONSTANT, Type::Image { sampled: 2, .. }) => Some(BindingKind::StorageImage),
        _ => None,
    };
    (kind, count)
}

#[test]
fn specialization_constants_have_their_ids() {
    let want = specialization_ids();
    let mut used = BTreeSet::new();
    for (shader, module) in modules() {
        for (name, id) in module.specialization() {
            // GLSL has no name for the constant that is a workgroup's width.
            let name = if name.is_empty() { "LANES" } else { name };
            let wanted = want.get(name);
            assert_eq!(Some(&id), wanted, "{}: constant_id of {name}", shader.name);
            used.insert(name.to_owned());
        }
    }
    let all: BTreeSet<_> = want.into_keys().collect();
    assert_eq!(used, all, "constants that shaders use against constants declared");
}

/// `NAME` has the id `SPEC_NAME`; a parameter's slot has `SPEC_SLOT` + its row.
fn specialization_ids() -> BTreeMap<String, u32> {
    let single = constants().filter_map(|(name, id)| Some((name.strip_prefix("SPEC_")?, id)));
    let single = single.filter(|&(name, _)| name != "SLOT");
    let slots = PARAMETERS.map(|parameter| (slot_name(parameter), shared::SPEC_SLOT + parameter as u32));
    single.map(|(name, id)| (name.to_owned(), id)).chain(slots).collect()
}

const PARAMETERS: [Parameter; amas::scene::material::PARAMETER_COUNT] = [
    Parameter::Color,
    Parameter::Specular,
    Parameter::Roughness,
    Parameter::Aspect,
    Parameter::Sigma,
    Parameter::Eta,
    Parameter::Metallic,
    Parameter::SpecularTint,
    Parameter::Sheen,
    Parameter::SheenTint,
    Parameter::Clearcoat,
    Parameter::ClearcoatGloss,
    Parameter::Subsurface,
    Parameter::Normal,
    Parameter::Mask,
];

/// `SpecularTint` → `SLOT_SPECULAR_TINT`.
fn slot_name(parameter: Parameter) -> String {
    let mut name = "SLOT".to_owned();
    for letter in format!("{parameter:?}").chars() {
        if letter.is_uppercase() {
            name.push('_');
        }
        name.push(letter.to_ascii_uppercase());
    }
    name
}
