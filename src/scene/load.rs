//! The way from a scene file to a [`Scene`].

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use toml::de::DeTable;

use super::Scene;
use super::bind::Library;
use super::decode::{Textures, Use};
use super::files::Files;
use super::material::{Material, Model, Parameter};
use super::obj::{self, Obj};
use super::parse::{Source, Value, camera, light, material, mesh, render};
use crate::error::{Error, Result};

/// Loads the scene file at `path` (TOML, UTF-8) with everything it names. `overrides` are pairs of a key of
/// `[render]`, with or without `render.`, and a TOML value, as `--set` takes them.
///
/// # Errors
/// [`Error::Input`] with file, line, cause and remedy if a file is missing, damaged or breaks a rule of the
/// format; [`Error::Usage`] if an override does.
pub fn load(path: &Path, overrides: &[(String, String)]) -> Result<Scene> {
    let bytes = std::fs::read(path).map_err(|error| {
        Error::input(path, None, format!("cannot read the scene: {error}"), "check the path and its rights")
    })?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let before = bytes.iter().take(error.valid_up_to()).filter(|byte| **byte == b'\n').count();
        Error::input(path, 1 + before, "the scene is not UTF-8 text", "save it as UTF-8")
    })?;
    let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    read(path, text, &Files::Disk(folder), overrides)
}

/// Loads a scene that is part of the program: `toml` is its text, `files` holds whatever it names by relative
/// path, and messages call it `name`. See [`load`] for `overrides`.
///
/// # Errors
/// As [`load`].
pub fn load_embedded(
    name: &str,
    toml: &str,
    files: &[(&str, &[u8])],
    overrides: &[(String, String)],
) -> Result<Scene> {
    read(Path::new(name), toml, &Files::Embedded(files), overrides)
}

fn read(path: &Path, text: &str, files: &Files, overrides: &[(String, String)]) -> Result<Scene> {
    let source = Source::file(path, text.trim_start_matches('\u{feff}'));
    let document = DeTable::parse(source.text()).map_err(|error| source.syntax(&error))?;
    let root = source.root(&document);
    root.allow(&["render", "camera", "material", "mesh", "light"])?;
    let mut loader = Loader::new(files);
    loader.scene.render = render::settings(&root)?;
    for (key, value) in overrides {
        render::set(&mut loader.scene.render, path, key, value)?;
    }
    loader.scene.cameras = camera::cameras(&root)?;
    material::materials(&mut loader, &root)?;
    light::lights(&mut loader, &root)?;
    loader.seal_names();
    mesh::meshes(&mut loader, &root)?;
    Ok(loader.finish())
}

/// The scene under construction, and what has been read for it.
pub(super) struct Loader<'a> {
    pub(super) files: &'a Files<'a>,
    pub(super) scene: Scene,
    pub(super) textures: Textures<'a>,
    /// `[[material]]` by name; the names of MTL materials are not among them.
    named: HashMap<String, u32>,
    sealed: bool,
    objs: HashMap<String, Rc<Obj>>,
    /// By the path of the OBJ file.
    pub(super) libraries: HashMap<String, Rc<Library>>,
    /// Materials made of MTL entries, by file and name.
    pub(super) from_mtl: HashMap<(String, String), u32>,
    pub(super) fallback: Option<u32>,
}

impl<'a> Loader<'a> {
    fn new(files: &'a Files<'a>) -> Self {
        Self {
            files,
            scene: Scene::default(),
            textures: Textures::new(files),
            named: HashMap::new(),
            sealed: false,
            objs: HashMap::new(),
            libraries: HashMap::new(),
            from_mtl: HashMap::new(),
            fallback: None,
        }
    }

    /// From now on new materials are not found by name.
    fn seal_names(&mut self) {
        self.sealed = true;
    }

    fn finish(mut self) -> Scene {
        let (textures, warnings) = self.textures.into_parts();
        self.scene.textures = textures;
        self.scene.warnings.extend(warnings);
        self.scene
    }

    /// Adds a sentence for the user, once.
    pub(super) fn warn(&mut self, sentence: String) {
        if !self.scene.warnings.contains(&sentence) {
            self.scene.warnings.push(sentence);
        }
    }

    /// The `[[material]]` of that name.
    pub(super) fn material_named(&self, name: &str) -> Option<u32> {
        self.named.get(name).copied()
    }

    /// Adds a material and returns its index.
    pub(super) fn add_material(&mut self, material: Material) -> u32 {
        let index = self.scene.materials.len() as u32;
        let color = material.value(Parameter::Color).constant;
        if material.model != Model::Metal && color.iter().any(|x| *x > 1.0) {
            self.warn(format!("the material \"{}\" reflects more light than it receives", material.name));
        }
        if !self.sealed {
            self.named.insert(material.name.clone(), index);
        }
        self.scene.materials.push(material);
        index
    }

    /// The path of the file that a string of the scene file names.
    pub(super) fn find(&self, value: &Value) -> Result<String> {
        let name = value.string()?;
        self.files.find("", name).ok_or_else(|| {
            let cause = format!("names \"{name}\", which does not exist");
            value.error(cause, "check the name; paths are relative to the scene file")
        })
    }

    /// The texture that a string of the scene file names.
    pub(super) fn texture(&mut self, value: &Value, usage: Use) -> Result<u32> {
        let path = self.find(value)?;
        self.textures.load(&path, usage)
    }

    /// The bytes of a file that exists.
    pub(super) fn read(&self, path: &str) -> Result<Cow<'a, [u8]>> {
        self.files.read(path).map_err(|error| {
            Error::input(
                self.files.display(path),
                None,
                format!("cannot read the file: {error}"),
                "check its rights",
            )
        })
    }

    /// The text of a file in whatever encoding: OBJ and MTL files only need ASCII to be understood.
    pub(super) fn read_lossy(&self, path: &str) -> Result<String> {
        Ok(String::from_utf8_lossy(&self.read(path)?).into_owned())
    }

    /// The OBJ file at `path`, read once.
    pub(super) fn obj(&mut self, path: &str) -> Result<Rc<Obj>> {
        if let Some(obj) = self.objs.get(path) {
            return Ok(Rc::clone(obj));
        }
        let obj = Rc::new(obj::read(&self.files.display(path), &self.read_lossy(path)?)?);
        self.objs.insert(path.to_owned(), Rc::clone(&obj));
        Ok(obj)
    }
}
