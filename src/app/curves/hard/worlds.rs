//! Scenes on which clusters and virtual lights break. A further one is a row here.

use crate::error::Result;
use crate::scene::{AreaShape, Scene, load_embedded};
use glam::Vec3;

const ROOM: &str = include_str!("../../../../scenes/indirect.toml");

/// A scene that is hard.
pub(super) struct World {
    pub(super) case: &'static str,
    /// Judged is gathered light, else the clusters' picture.
    pub(super) gathered: bool,
    /// Scene file.
    text: fn() -> String,
    /// What no scene file may have.
    edit: fn(&mut Scene),
}

const fn clusters(case: &'static str, text: fn() -> String) -> World {
    World { case, gathered: false, text, edit: |_| () }
}

const fn gathered(case: &'static str, text: fn() -> String) -> World {
    World { case, gathered: true, text, edit: |_| () }
}

pub(super) const WORLDS: &[World] = &[
    clusters("near plane at 1e-3 m, none far, lights from 1 cm to 3 km", || plain(EYE, "", LIGHTS)),
    clusters("the same, straight down from a light's place", || {
        let inside = "position = [0, 0.3, 0]\ntarget = [0, 0, 0]\nup = [0, 0, 1]";
        plain(inside, "", &point("[0, 0.3, 0]", ", range = 1"))
    }),
    clusters("the same in one pixel", || plain(EYE, "size = [1, 1]", LIGHTS)),
    clusters("the same, 3 × 64 pixels", || plain(EYE, "size = [3, 64]", LIGHTS)),
    clusters("orthographic, 20 m high", || {
        plain(EYE, "", LIGHTS).replace("vertical_fov = 60", "orthographic_height = 20")
    }),
    clusters("lights that just reach the floor, and lights on it", || {
        let touching = "[[light]]\ntype = \"points\"\ngenerate = { count = 256, seed = 1, min = [-4, 1, -4], max = [4, 1, 4], \
             intensity = [1, 2], range = 1.0001 }\n";
        let lying = "[[light]]\ntype = \"points\"\ngenerate = { count = 256, seed = 2, min = [-4, 0, -4], max = [4, 0, 4], \
             intensity = [0.01, 0.02], range = 0.5 }\n";
        plain(EYE, "", &[touching, lying].concat())
    }),
    gathered("the eye 0.1 mm off a wall, lights on walls and in a corner", || {
        let lights = point("[0, 2, 0]", "") + &point("[-1, 0, -1]", ", range = 2");
        (dark_room() + &lights)
            .replace("position = [0.0, 1.0, 3.2]", "position = [-0.9999, 1, 0.5]")
            .replace("target = [0.0, 0.95, 0.0]", "target = [-0.9, 0.9, 0]")
            .replace("near = 0.01", "near = 1e-5")
    }),
    gathered("all virtual lights on a millimetre of floor, the light 1 mm above it", || {
        let floor = "[[mesh]]\nshape = \"plane\"\nsize = 1e-3\nmaterial = \"floor\"\n";
        let eye = "position = [0, 0.002, 0.002]\ntarget = [0, 0, 0]";
        let keys = "shadows = true\nindirect = { vpls = 256, bounces = 3 }";
        scene(eye, keys, &[floor, &point("[0, 1e-3, 0]", "")].concat()).replace("near = 1e-3", "near = 1e-5")
    }),
    gathered("everything is black", || {
        let colors = [
            "[0.75, 0.72, 0.68]",
            "[0.62, 0.1, 0.07]",
            "[0.1, 0.2, 0.55]",
            "[0.3, 0.3, 0.3]",
            "[0.9, 0.9, 0.9]",
        ];
        let gold = "type = \"metal\"\npreset = \"gold\"\nalpha = 0.2";
        colors
            .into_iter()
            .fold(room(), |text, color| text.replace(color, "[0, 0, 0]"))
            .replace(gold, "type = \"matte\"\ncolor = [0, 0, 0]")
    }),
    gathered("a light in a closed box", || {
        let hung = dark_room().replace("translate = [0.35, 0.3, -0.1]", "translate = [0.35, 0.5, -0.1]");
        hung + &point("[0.35, 0.5, -0.1]", "")
    }),
    World {
        case: "an area light without area",
        gathered: true,
        text: room,
        edit: |scene| {
            let shape = AreaShape::Rect { center: Vec3::new(0.0, 1.9, 0.0), u: Vec3::X, v: Vec3::X };
            scene.area_lights.iter_mut().for_each(|light| light.shape = shape.clone());
        },
    },
];

impl World {
    pub(super) fn scene(&self) -> Result<Scene> {
        let mut scene = load_embedded("hard.toml", &(self.text)(), &[], &[])?;
        (self.edit)(&mut scene);
        Ok(scene)
    }

    pub(super) fn what(&self) -> &'static str {
        if self.gathered { "gathered light" } else { "clusters" }
    }
}

const EYE: &str = "position = [0, 1.5, 3]\ntarget = [0, 1, 0]";
/// In every decade of distance.
const LIGHTS: &str = "[[light]]\ntype = \"points\"\ngenerate = { count = 512, seed = 1, min = [-0.3, 1.2, 2], max = [0.3, 1.6, 3], intensity = [1e-5, 1e-4], range = 0.05 }\n\
     [[light]]\ntype = \"points\"\ngenerate = { count = 512, seed = 2, min = [-3, 0, -3], max = [3, 2, 3], intensity = [0.01, 0.1], range = 0.5 }\n\
     [[light]]\ntype = \"points\"\ngenerate = { count = 512, seed = 3, min = [-100, 0, -200], max = [100, 10, 0], intensity = [1, 10], range = 20 }\n\
     [[light]]\ntype = \"points\"\ngenerate = { count = 512, seed = 4, min = [-3e3, 0, -3e3], max = [3e3, 100, 0], intensity = [1e3, 1e4], range = 400 }\n";

fn point(position: &str, more: &str) -> String {
    let range = more.replacen(", ", "\n", 1);
    format!("[[light]]\ntype = \"point\"\nposition = {position}\nintensity = [1, 1, 1]{range}\n")
}

/// A plane of 10 km with a ball on it.
fn plain(eye: &str, keys: &str, lights: &str) -> String {
    let things = "[[mesh]]\nshape = \"plane\"\nsize = 1e4\nmaterial = \"floor\"\n\
         [[mesh]]\nshape = \"sphere\"\nradius = 0.5\ntranslate = [0.7, 0.5, 0]\nmaterial = \"floor\"\n";
    scene(eye, keys, &[things, lights].concat())
}

fn scene(eye: &str, keys: &str, more: &str) -> String {
    let size = if keys.contains("size") { "" } else { "size = [48, 32]\n" };
    format!(
        "[render]\n{size}{keys}\n[[camera]]\nname = \"main\"\n{eye}\nvertical_fov = 60\nnear = 1e-3\n\
         [[material]]\nname = \"floor\"\ntype = \"plastic\"\ndiffuse = [0.4, 0.4, 0.4]\nroughness = 0.5\n{more}"
    )
}

/// The room with its panel.
fn room() -> String {
    ROOM.replacen("size = [640, 480]", "size = [16, 12]", 1).replacen("vpls = 16384", "vpls = 256", 1)
}

/// The room without it.
fn dark_room() -> String {
    room().split("[[light]]").next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every scene loads, and is what its case says: no replacement of a text has found nothing.
    #[test]
    fn scenes() {
        for world in WORLDS {
            let scene = world.scene().unwrap();
            assert_eq!(world.gathered, scene.render.vpls > 0, "{}", world.case);
            assert!(scene.render.size[0] <= 48, "{}", world.case);
            let eye = scene.cameras[0].position;
            match world.case {
                case if case.starts_with("the eye") => assert!((eye.x + 1.0).abs() < 2e-4),
                case if case.contains("box") => {
                    assert_eq!((scene.point_lights.len(), scene.area_lights.len()), (1, 0))
                }
                case if case.contains("millimetre") => {
                    assert_eq!((scene.meshes.len(), scene.cameras[0].near), (1, 1e-5))
                }
                case if case.contains("black") => {
                    let colors = scene.materials.iter().map(|material| &material.parameters[0].constant);
                    assert!(
                        colors.clone().all(|color| *color == [0.0; 3]),
                        "{:?}",
                        colors.collect::<Vec<_>>()
                    );
                }
                _ => {}
            }
        }
    }
}
