//! Which material a group of triangles gets.
//!
//! In this order: `material` of the `[[mesh]]`; `materials` of the `[[mesh]]` by the group's `usemtl` name; the
//! `[[material]]` of that name; the entry of that name in the OBJ's MTL files; and a grey matte, with a warning.

use std::collections::HashMap;
use std::rc::Rc;

use super::load::Loader;
use super::material::{Material, Model, Parameter};
use super::{mtl, obj};
use crate::error::Result;

/// Reflectance where nothing is known.
const GREY: f32 = 0.5;

/// What a `[[mesh]]` says about its materials, as indices into `Scene::materials`.
#[derive(Default)]
pub(super) struct Binding {
    /// File and line of the `[[mesh]]`.
    pub(super) place: String,
    pub(super) all: Option<u32>,
    pub(super) by_name: HashMap<String, u32>,
}

/// The entries of an OBJ's MTL files by name, each with the path of its file.
pub(super) type Library = HashMap<String, (String, mtl::Entry)>;

/// The material of a group; `obj` is the path of its OBJ file and what is in it.
pub(super) fn material(
    loader: &mut Loader,
    binding: &Binding,
    name: Option<&str>,
    obj: Option<(&str, &obj::Obj)>,
) -> Result<u32> {
    let Some(name) = name else {
        return Ok(binding.all.unwrap_or_else(|| fallback(loader)));
    };
    if let Some(index) = binding.all.or_else(|| binding.by_name.get(name).copied()) {
        return Ok(index);
    }
    if let Some(index) = loader.material_named(name) {
        return Ok(index);
    }
    let Some((path, obj)) = obj else {
        return Ok(fallback(loader));
    };
    let library = library(loader, &binding.place, path, obj)?;
    let Some((file, entry)) = library.get(name) else {
        let cause = format!(
            "the material \"{name}\" of \"{path}\" has neither a [[material]] nor an MTL entry; it is drawn grey"
        );
        let remedy = format!("add a [[material]] of that name, or `materials = {{ \"{name}\" = \"…\" }}`");
        loader.warn(&binding.place, cause, remedy);
        return Ok(fallback(loader));
    };
    let key = (file.clone(), name.to_owned());
    if let Some(index) = loader.from_mtl.get(&key) {
        return Ok(*index);
    }
    let unique = unique_name(loader, name, file);
    let material = mtl::material(loader, file, entry, unique)?;
    let place = mtl::place(loader, file, entry);
    let index = loader.add_material(material, &place);
    loader.from_mtl.insert(key, index);
    Ok(index)
}

/// `name`, or if another material has it, `name (file)`, and so on until it is unique.
///
/// MTL materials must not answer to plain names: those belong to `[[material]]`.
fn unique_name(loader: &Loader, name: &str, file: &str) -> String {
    let taken = |name: &str| loader.scene.materials.iter().any(|material| material.name == name);
    let mut unique = name.to_owned();
    while taken(&unique) {
        unique = format!("{unique} ({file})");
    }
    unique
}

fn library(loader: &mut Loader, place: &str, path: &str, obj: &obj::Obj) -> Result<Rc<Library>> {
    if let Some(library) = loader.libraries.get(path) {
        return Ok(Rc::clone(library));
    }
    let mut library = Library::new();
    for reference in &obj.libraries {
        for file in library_files(loader, place, path, reference) {
            let text = loader.read_lossy(&file)?;
            for entry in mtl::read(&loader.files.display(&file), &text)? {
                library.insert(entry.name.clone(), (file.clone(), entry));
            }
        }
    }
    let library = Rc::new(library);
    loader.libraries.insert(path.to_owned(), Rc::clone(&library));
    Ok(library)
}

/// `mtllib` may name one file with spaces, or several files.
fn library_files(loader: &mut Loader, place: &str, path: &str, reference: &str) -> Vec<String> {
    if let Some(file) = loader.files.find_nearby(path, reference) {
        return vec![file];
    }
    let mut files = Vec::new();
    for name in reference.split_whitespace() {
        match loader.files.find_nearby(path, name) {
            Some(file) => files.push(file),
            None => {
                let cause = format!("the material file \"{reference}\" of \"{path}\" is missing");
                loader.warn(place, cause, "put it beside the OBJ, or give the mesh a `material`");
                break;
            }
        }
    }
    files
}

/// The grey matte of everything that has no material.
fn fallback(loader: &mut Loader) -> u32 {
    if let Some(index) = loader.fallback {
        return index;
    }
    let mut material = Material {
        name: unique_name(loader, "grey", "default"),
        model: Model::Matte,
        parameters: Default::default(),
        squared_roughness: false,
        two_sided: true,
    };
    material.parameters[Parameter::Color as usize].constant = [GREY; 3];
    // Grey reflects less than it receives: nothing is said of its place.
    let index = loader.add_material(material, "");
    loader.fallback = Some(index);
    index
}
