//! A scene's file with what was changed in the window: everything else, comments too, stays as it is.

mod entries;

use super::picked::{Item, Picked};
use crate::error::{Error, Result};
use crate::image::write_atomically;
use crate::scene::{Material, Model, Parameter, RenderSettings, Scene};
use entries::{set_area, set_material, set_point, set_render};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use toml_edit::DocumentMut;

/// A parameter that a model has: its key, how many numbers, and their upper end.
pub(super) struct Row {
    pub(super) parameter: Parameter,
    pub(super) key: &'static str,
    pub(super) channels: usize,
    pub(super) most: f32,
}

/// The parameters of a material that can be changed.
pub(super) fn rows(material: &Material) -> Vec<Row> {
    use Parameter as P;
    let row = |parameter, key, channels, most| Row { parameter, key, channels, most };
    let roughness = row(P::Roughness, if material.squared_roughness { "roughness" } else { "alpha" }, 1, 1.0);
    let (diffuse, specular) = (row(P::Color, "diffuse", 3, 1.0), row(P::Specular, "specular", 3, 1.0));
    let scalar = |parameter, key| row(parameter, key, 1, 1.0);
    match material.model {
        Model::Matte => vec![row(P::Color, "color", 3, 1.0), row(P::Sigma, "sigma", 1, 90.0)],
        Model::Plastic => vec![diffuse, specular, roughness],
        Model::Substrate => vec![diffuse, specular, roughness],
        Model::Metal => vec![row(P::Color, "eta", 3, 10.0), row(P::Specular, "k", 3, 20.0), roughness],
        Model::Principled => vec![
            row(P::Color, "base_color", 3, 1.0),
            scalar(P::Metallic, "metallic"),
            roughness,
            scalar(P::SpecularTint, "specular_tint"),
            scalar(P::Sheen, "sheen"),
            scalar(P::SheenTint, "sheen_tint"),
            scalar(P::Clearcoat, "clearcoat"),
            scalar(P::ClearcoatGloss, "clearcoat_gloss"),
            scalar(P::Subsurface, "subsurface"),
        ],
    }
}

/// Writes the scene of file `original` with its changes to `target`; what could not be written, as sentences.
pub(super) fn save(
    original: &Path,
    target: &Path,
    scene: &Scene,
    render: &RenderSettings,
    before: &BTreeMap<Picked, Item>,
) -> Result<Vec<String>> {
    if original.parent() != target.parent() {
        return Err(Error::usage(
            format!("{}: the files that the scene names lie beside {}", target.display(), original.display()),
            "save it in the same folder",
        ));
    }
    let text = std::fs::read_to_string(original).map_err(|error| {
        Error::input(original, None, format!("cannot read the scene: {error}"), "check the file")
    })?;
    let (text, left_out) = edited(&text, scene, render, before)
        .map_err(|cause| Error::input(original, None, cause, "check the file"))?;
    write_atomically(target, |file| file.write_all(text.as_bytes()))?;
    Ok(left_out)
}

/// The text with its changes, and sentences on what could not be changed in it.
fn edited(
    text: &str,
    scene: &Scene,
    render: &RenderSettings,
    before: &BTreeMap<Picked, Item>,
) -> Result<(String, Vec<String>), String> {
    let mut document: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
    let mut left_out = Vec::new();
    if render != &scene.render {
        let table = document.entry("render").or_insert_with(toml_edit::table);
        let table = table.as_table_like_mut().ok_or("render is no table")?;
        set_render(table, render, &scene.render);
    }
    for (&picked, old) in before {
        let now = picked.of(scene);
        let done = match (picked, old, &now) {
            (Picked::Material(_), Item::Material(old), Some(Item::Material(now))) => {
                set_material(&mut document, old, now)
            }
            (Picked::Point(index), _, Some(Item::Point(now))) => {
                set_point(&mut document, &scene.point_groups, index, now)
            }
            (Picked::Area(index), Item::Area(old), Some(Item::Area(now))) => {
                set_area(&mut document, index, old, now)
            }
            _ => Ok(()),
        };
        left_out.extend(done.err());
    }
    Ok((document.to_string(), left_out))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"# A hall.
[render]
size = [8, 8]   # small
exposure = 1.5  # bright

[[camera]]
name = "main"
position = [0, 1, 4]
target = [0, 1, 0]
vertical_fov = 45

[[material]]
name = "gold"
type = "metal"
preset = "gold" # as mined
roughness = 0.3

[[material]]
name = "floor"
type = "matte"
color = [0.5, 0.5, 0.5] # grey

[[mesh]]
shape = "plane"
size = [4, 4]
material = "floor"

[[light]]
type = "points"
generate = { count = 3, min = [0, 0, 0], max = [1, 1, 1], intensity = [1, 2] }

[[light]]
type = "point"
position = [0, 2, 0]
intensity = [1, 1, 1] # white
range = 5.0

[[light]]
type = "disk"
center = [0, 3, 0]
normal = [0, -1, 0]
radius = 0.5
radiance = [4, 4, 4]
"#;

    /// What is saved is loaded as it was in the window, and the rest of the file has not changed.
    #[test]
    fn changes_survive_and_comments_stay() {
        let folder = tempfile::tempdir().unwrap();
        let [original, target] = ["hall.toml", "edited.toml"].map(|name| folder.path().join(name));
        std::fs::write(&original, TEXT).unwrap();
        let mut scene = crate::scene::load(&original, &[]).unwrap();
        let render = scene.render.clone();
        let picks =
            [Picked::Material(0), Picked::Material(1), Picked::Point(1), Picked::Point(3), Picked::Area(0)];
        let before: BTreeMap<_, _> = picks.map(|picked| (picked, picked.of(&scene).unwrap())).into();
        scene.render.exposure = -0.7;
        scene.render.shadows = true;
        (scene.render.vpls, scene.render.bounces) = (4096, 2);
        scene.materials[0].parameters[Parameter::Color as usize].constant[1] = 0.1;
        scene.materials[1].parameters[Parameter::Color as usize].constant = [0.1, 0.2, 0.3];
        scene.materials[1].two_sided = false;
        scene.point_lights[3].position.x = 0.1;
        scene.point_lights[3].range = None;
        scene.area_lights[0].radiance.z = 7.25;
        let left_out = save(&original, &target, &scene, &render, &before).unwrap();
        assert_eq!(left_out, ["Point light 1 is one of a group, and stays as it is there."]);
        let saved = crate::scene::load(&target, &[]).unwrap();
        assert_eq!(saved.render, scene.render);
        assert_eq!(saved.materials, scene.materials);
        assert_eq!(saved.point_lights, scene.point_lights);
        assert_eq!(saved.area_lights, scene.area_lights);
        let text = std::fs::read_to_string(&target).unwrap();
        for kept in ["# A hall.", "size = [8, 8]   # small", "exposure = -0.7  # bright", "# grey", "# white"]
        {
            assert!(text.contains(kept), "{kept} is not in: {text}");
        }
        assert!(!text.contains("preset"), "{text}");
        // Nothing changed, nothing written.
        let same = edited(TEXT, &crate::scene::load(&original, &[]).unwrap(), &render, &BTreeMap::new());
        assert_eq!(same, Ok((TEXT.into(), Vec::new())));
    }

    #[test]
    fn scenes_stay_beside_what_they_name() {
        let scene = Scene::default();
        let saved = save(Path::new("a/b.toml"), Path::new("c.toml"), &scene, &scene.render, &BTreeMap::new());
        assert!(saved.is_err_and(|error| error.to_string().contains("same folder")));
    }
}
