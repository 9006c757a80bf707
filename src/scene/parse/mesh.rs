//! `[[mesh]]`: OBJ files and built-in shapes.
//!
//! Where the contract is silent: `plane` and `box` take `size`, the full edge lengths, by default 1; `sphere` and
//! `disk` take `radius`, by default 1; a sphere's `segments` are longitude and latitude, by default 32 and 16, or
//! one number n for n and n/2; a disk's are its sectors, by default 64. What has no material is drawn grey, with a
//! warning. `normals` only matters to faces without normals.

use glam::DVec3;

use super::{Table, Value};
use crate::error::Result;
use crate::scene::bind::{self, Binding};
use crate::scene::geometry::{self, Group, Normals, Transform};
use crate::scene::load::Loader;
use crate::scene::material::{Material, Model, Parameter};
use crate::scene::mesh::Mesh;
use crate::scene::{obj, shapes};

const COMMON_KEYS: [&str; 4] = ["material", "translate", "rotate", "scale"];

/// Reads every `[[mesh]]` into the loader's scene.
pub(in crate::scene) fn meshes(loader: &mut Loader, root: &Table) -> Result<()> {
    root.tables("mesh")?.iter().try_for_each(|table| mesh(loader, table))
}

fn mesh(loader: &mut Loader, table: &Table) -> Result<()> {
    loader.advance()?;
    match (table.get("obj"), table.get("shape")) {
        (Some(file), None) => from_obj(loader, table, &file),
        (None, Some(shape)) => from_shape(loader, table, &shape),
        (Some(_), Some(shape)) => Err(shape.error("stands beside `obj`", "keep one of the two")),
        (None, None) => Err(table.error(
            "the mesh has neither `obj` nor `shape`",
            "add `obj = \"model.obj\"` or `shape = \"sphere\"` (plane, box, sphere, disk)",
        )),
    }
}

fn from_obj(loader: &mut Loader, table: &Table, file: &Value) -> Result<()> {
    table.allow(&[&COMMON_KEYS[..], &["obj", "materials", "normals"]].concat())?;
    let path = loader.find(file)?;
    let obj = loader.obj(&path)?;
    let by_name = remap(loader, table, &obj)?;
    let binding = Binding { place: table.place(), all: material(loader, table)?, by_name };
    let choices = [("smooth", Normals::Smooth), ("flat", Normals::Flat)];
    let normals = table.get_or("normals", Normals::Smooth, |value| value.choice(&choices))?;
    add(loader, table, &obj.groups, normals, &binding, Some((&path, &obj)))
}

fn from_shape(loader: &mut Loader, table: &Table, shape: &Value) -> Result<()> {
    let allow = |own: &[&str]| table.allow(&[&COMMON_KEYS[..], &["shape"], own].concat());
    let group = match shape.string()? {
        "plane" => {
            allow(&["size"])?;
            shapes::plane(table.get_or("size", [1.0; 2], lengths)?)
        }
        "box" => {
            allow(&["size"])?;
            shapes::cuboid(table.get_or("size", [1.0; 3], lengths)?)
        }
        "sphere" => {
            allow(&["radius", "segments"])?;
            let radius = table.get_or("radius", 1.0, Value::positive)?;
            shapes::sphere(radius, table.get_or("segments", [32, 16], sphere_segments)?)
        }
        "disk" => {
            allow(&["radius", "segments"])?;
            let segments = table.get_or("segments", 64, |value| value.integer(3..=4096))?;
            shapes::disk(table.get_or("radius", 1.0, Value::positive)?, segments)
        }
        other => return Err(shape.unknown(other, ["plane", "box", "sphere", "disk"].into_iter())),
    };
    let binding = Binding { place: table.place(), all: material(loader, table)?, ..Binding::default() };
    add(loader, table, &[group], Normals::Smooth, &binding, None)
}

/// One length for all axes, or one for each.
fn lengths<const N: usize>(value: &Value) -> Result<[f64; N]> {
    if !value.is_array() {
        return Ok([value.positive()?; N]);
    }
    let mut lengths = [0.0; N];
    for (length, item) in lengths.iter_mut().zip(value.array::<N>("[1.0, 1.0, 1.0]")?) {
        *length = item.positive()?;
    }
    Ok(lengths)
}

fn sphere_segments(value: &Value) -> Result<[u32; 2]> {
    if value.is_array() {
        let [longitude, latitude] = value.array("[32, 16]")?;
        return Ok([longitude.integer(3..=2048)?, latitude.integer(2..=1024)?]);
    }
    let segments = value.integer(3..=2048)?;
    Ok([segments, (segments / 2).max(2)])
}

/// `material = "name"`.
fn material(loader: &Loader, table: &Table) -> Result<Option<u32>> {
    table.get("material").map(|value| named(loader, &value)).transpose()
}

fn named(loader: &Loader, value: &Value) -> Result<u32> {
    let name = value.string()?;
    loader.material_named(name).ok_or_else(|| {
        value.unknown(name, loader.scene.materials.iter().map(|material| material.name.as_str()))
    })
}

/// `materials = { old = "new" }`.
fn remap(
    loader: &mut Loader,
    table: &Table,
    obj: &obj::Obj,
) -> Result<std::collections::HashMap<String, u32>> {
    let mut remap = std::collections::HashMap::new();
    let Some(value) = table.get("materials") else {
        return Ok(remap);
    };
    for value in value.table()?.values() {
        let index = named(loader, &value)?;
        let mut names = obj.groups.iter().filter_map(|group| group.material.as_deref());
        if !names.clone().any(|name| name == value.key()) {
            let best = names.by_ref().map(|name| (strsim::jaro_winkler(name, value.key()), name));
            let best = best.max_by(|a, b| a.0.total_cmp(&b.0));
            let hint = best.map(|(_, name)| format!("; the nearest is \"{name}\"")).unwrap_or_default();
            let cause = format!("`materials` names \"{}\", which the OBJ lacks{hint}", value.key());
            loader.warn(&value.place(), cause, "correct the name, or remove it");
        }
        remap.insert(value.key().to_owned(), index);
    }
    Ok(remap)
}

fn transform(table: &Table) -> Result<Transform> {
    let translate = table.get_or("translate", DVec3::ZERO, Value::vec3)?;
    let rotate = table.get_or("rotate", DVec3::ZERO, Value::vec3)?;
    let scale = table.get_or("scale", DVec3::ONE, |value| {
        let scale = if value.is_array() { value.vec3()? } else { DVec3::splat(value.number()?) };
        if scale.to_array().iter().any(|x| x.abs() < 1e-18) {
            return Err(
                value.error("has an axis that is 0", "give a scale other than 0; negative ones mirror")
            );
        }
        Ok(scale)
    })?;
    Ok(Transform::new(scale, rotate, translate))
}

fn add(
    loader: &mut Loader,
    table: &Table,
    groups: &[Group],
    normals: Normals,
    binding: &Binding,
    obj: Option<(&str, &obj::Obj)>,
) -> Result<()> {
    let Some(meshes) = geometry::bake(groups, &transform(table)?, normals) else {
        let cause = format!("the mesh reaches beyond ±{:e} m", super::LARGEST);
        return Err(table.error(cause, "choose a smaller `scale`, `size` or `translate`"));
    };
    if meshes.is_empty() {
        let cause = "the mesh has no triangle with an area";
        return Err(table.error(cause, "check the OBJ, and that `scale` does not flatten it"));
    }
    for (name, mut mesh) in meshes {
        if name.is_none() && binding.all.is_none() {
            let cause = "faces without a material are drawn grey";
            loader.warn(&table.place(), cause, "add `material = \"…\"` to the mesh");
        }
        mesh.material = bind::material(loader, binding, name.as_deref(), obj)?;
        check_uvs(loader, table, &mesh);
        loader.scene.meshes.push(mesh);
    }
    Ok(())
}

/// Warns where a material needs texture coordinates that the mesh does not have.
fn check_uvs(loader: &mut Loader, table: &Table, mesh: &Mesh) {
    let material = &loader.scene.materials[mesh.material as usize];
    let textured = material.parameters.iter().any(|value| value.texture.is_some());
    let has_uvs = mesh.vertices.iter().any(|vertex| vertex.uv != [0.0; 2]);
    let has_tangents = mesh.vertices.iter().any(|vertex| vertex.tangent != [0.0; 4]);
    let cause = if textured && !has_uvs {
        "has textures, but the mesh has no texture coordinates; one texel covers it all"
    } else if anisotropic(material) && !has_tangents {
        "is anisotropic, but the mesh has no texture coordinates; it is drawn isotropic"
    } else {
        return;
    };
    let cause = format!("the material \"{}\" {cause}", material.name);
    loader.warn(
        &table.place(),
        cause,
        "export the OBJ with texture coordinates (vt), or choose another material",
    );
}

fn anisotropic(material: &Material) -> bool {
    let aspect = material.value(Parameter::Aspect);
    let model = matches!(material.model, Model::Metal | Model::Substrate | Model::Principled);
    model && (aspect.texture.is_some() || aspect.constant[0] != 1.0)
}
