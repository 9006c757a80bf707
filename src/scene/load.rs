//! The way from a scene file to a [`Scene`].

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use indicatif::ProgressBar;
use toml::de::DeTable;

use super::bind::Library;
use super::decode::{Fault, Textures, Use};
use super::files::Files;
use super::material::{Material, Model, Parameter};
use super::obj::{self, Obj};
use super::parse::{Source, Table, Value, camera, light, material, mesh, render};
use super::{RenderSettings, Scene, studio};
use crate::error::{Error, Result};
use crate::image::extension;

/// Where a scene comes from.
#[derive(Clone, Copy, Debug)]
pub enum Origin<'a> {
    /// A scene file (TOML, UTF-8); or, by its extension, an OBJ file, which gets a camera and lights of its own.
    File(&'a Path),
    /// Part of the program: what messages call it, its text, and whatever it names by relative path.
    Embedded(&'a str, &'a str, &'a [(&'a str, &'a [u8])]),
}

/// Loads the scene file at `path` with everything it names. `overrides` are pairs of a key of `[render]`, with or without
/// `render.`, and a TOML value, as `--set` takes them.
///
/// # Errors
/// As [`Origin::load`].
pub fn load(path: &Path, overrides: &[(String, String)]) -> Result<Scene> {
    Origin::File(path).load(overrides, &ProgressBar::hidden())
}

/// Loads a scene that is part of the program: `toml` is its text, `files` holds whatever it names by relative
/// path, and messages call it `name`. See [`load`] for `overrides`.
///
/// # Errors
/// As [`Origin::load`].
pub fn load_embedded(
    name: &str,
    toml: &str,
    files: &[(&str, &[u8])],
    overrides: &[(String, String)],
) -> Result<Scene> {
    Origin::Embedded(name, toml, files).load(overrides, &ProgressBar::hidden())
}

impl Origin<'_> {
    /// Loads the scene; see [`load`] for `overrides`. `progress` advances by one for each material, mesh and light, its length
    /// grows by their number, and once it is finished or abandoned from outside, loading ends.
    ///
    /// # Errors
    /// [`Error::Input`] with file, line, cause and remedy if a file is missing, damaged or breaks a rule of the
    /// format; [`Error::Usage`] if an override does, or if loading was ended from outside.
    pub fn load(self, overrides: &[(String, String)], progress: &ProgressBar) -> Result<Scene> {
        match self {
            Self::Embedded(name, text, files) => {
                read(Path::new(name), text, &Files::Embedded(files), overrides, progress)
            }
            Self::File(path) => {
                let files = Files::below(path.parent().map_or_else(PathBuf::new, Path::to_path_buf));
                let mut scene = if extension(path) == "obj" {
                    let mut scene = read(path, &studio::around(path), &files, overrides, progress)?;
                    studio::furnish(&mut scene);
                    scene
                } else {
                    read(path, &text(path)?, &files, overrides, progress)?
                };
                scene.files = std::iter::once(path.to_path_buf()).chain(files.names()).collect();
                Ok(scene)
            }
        }
    }

    /// `[render]` alone, without the files that the scene names.
    ///
    /// # Errors
    /// As [`Origin::load`], as far as it is read.
    pub fn settings(self, overrides: &[(String, String)]) -> Result<RenderSettings> {
        let (path, text) = match self {
            Self::File(path) if extension(path) == "obj" => (path, Cow::Owned(studio::around(path))),
            Self::File(path) => (path, Cow::Owned(text(path)?)),
            Self::Embedded(name, text, _) => (Path::new(name), Cow::Borrowed(text)),
        };
        let source = Source::file(path, text.trim_start_matches('\u{feff}'));
        let document = DeTable::parse(source.text()).map_err(|error| source.syntax(&error))?;
        settings(&source.root(&document), path, overrides)
    }
}

fn text(path: &Path) -> Result<String> {
    let bytes = std::fs::read(path).map_err(|error| {
        Error::input(path, None, format!("cannot read the scene: {error}"), "check the path and its rights")
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = error.as_bytes().iter().take(valid).filter(|byte| **byte == b'\n').count();
        Error::input(path, 1 + before, "the scene is not UTF-8 text", "save it as UTF-8")
    })
}

fn settings(root: &Table, path: &Path, overrides: &[(String, String)]) -> Result<RenderSettings> {
    let mut settings = render::settings(root)?;
    for (key, value) in overrides {
        render::set(&mut settings, path, key, value)?;
    }
    Ok(settings)
}

fn read(
    path: &Path,
    text: &str,
    files: &Files,
    overrides: &[(String, String)],
    progress: &ProgressBar,
) -> Result<Scene> {
    let source = Source::file(path, text.trim_start_matches('\u{feff}'));
    let document = DeTable::parse(source.text()).map_err(|error| source.syntax(&error))?;
    let root = source.root(&document);
    root.allow(&["render", "camera", "material", "mesh", "light"])?;
    let mut loader = Loader::new(files, progress);
    loader.scene.render = settings(&root, path, overrides)?;
    loader.scene.cameras = camera::cameras(&root)?;
    for section in ["material", "light", "mesh"] {
        progress.inc_length(root.tables(section)?.len() as u64);
    }
    material::materials(&mut loader, &root)?;
    light::lights(&mut loader, &root)?;
    loader.seal_names();
    mesh::meshes(&mut loader, &root)?;
    Ok(loader.finish())
}

/// What the user is told of `place`, a file and its line.
pub(super) fn warning(place: &str, cause: &str, remedy: &str) -> String {
    format!("{place}: {cause}\n  remedy: {remedy}")
}

/// The scene under construction, and what has been read for it.
pub(super) struct Loader<'a> {
    pub(super) files: &'a Files<'a>,
    progress: &'a ProgressBar,
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
    fn new(files: &'a Files<'a>, progress: &'a ProgressBar) -> Self {
        Self {
            files,
            progress,
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

    /// A material, mesh or light is read; an error where nobody waits for the scene any more.
    pub(super) fn advance(&self) -> Result<()> {
        if self.progress.is_finished() {
            return Err(Error::usage("loading was cancelled", "load the scene again"));
        }
        self.progress.inc(1);
        Ok(())
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

    /// Tells the user, once, what was noticed at `place`, a file and its line.
    pub(super) fn warn(&mut self, place: &str, cause: impl AsRef<str>, remedy: impl AsRef<str>) {
        let text = warning(place, cause.as_ref(), remedy.as_ref());
        if !self.scene.warnings.contains(&text) {
            self.scene.warnings.push(text);
        }
    }

    /// The `[[material]]` of that name.
    pub(super) fn material_named(&self, name: &str) -> Option<u32> {
        self.named.get(name).copied()
    }

    /// Adds the material that stands at `place` and returns its index.
    pub(super) fn add_material(&mut self, material: Material, place: &str) -> u32 {
        let index = self.scene.materials.len() as u32;
        let color = material.value(Parameter::Color).constant;
        if material.model != Model::Metal && color.iter().any(|x| *x > 1.0) {
            let cause = format!("the material \"{}\" reflects more light than it receives", material.name);
            self.warn(place, cause, "give it a colour of at most 1 in every channel");
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
        self.textures
            .load(&path, usage, &value.place())
            .map_err(|Fault { cause, remedy }| value.error(format!("names \"{path}\": {cause}"), remedy))
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
