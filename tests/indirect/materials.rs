//! A room of each material, and textures, against the oracle's paths.

use crate::common::png::png;
use crate::support::{LAMP, MATTE, THINGS, judge, room, scene};

/// Three bounces: keys of `[render]`.
const THREE: &str = "size = [32, 24]\nindirect = { vpls = 2048, bounces = 3 }";

fn furnished(render: &str, floor: &str) -> amas::Scene {
    scene(&room(render, floor, &[LAMP, THINGS].concat()), &[])
}

#[test]
fn one_bounce() {
    judge("one bounce", furnished(&THREE.replace("bounces = 3", "bounces = 1"), MATTE), 1000);
}

#[test]
fn all_bounces() {
    judge("all bounces", furnished(&THREE.replace("bounces = 3", "bounces = 64"), MATTE), 1000);
}

#[test]
fn glossy_plastic() {
    let floor =
        "type = \"plastic\"\ndiffuse = [0.3, 0.3, 0.3]\nspecular = [0.9, 0.9, 0.9]\neta = 1.8\nalpha = 0.12";
    judge("plastic", furnished(THREE, floor), 1000);
}

#[test]
fn glossy_metal() {
    judge("metal", furnished(THREE, "type = \"metal\"\npreset = \"gold\"\nalpha = 0.2"), 1000);
}

/// Rough matte below, substrate and principled with a clear coat on it.
#[test]
fn other_models() {
    let more = "[[material]]\nname = \"substrate\"\ntype = \"substrate\"\ndiffuse = [0.4, 0.3, 0.2]\n\
         specular = [0.2, 0.2, 0.2]\nroughness = 0.5\nanisotropic = 0.5\n\
         [[material]]\nname = \"principled\"\ntype = \"principled\"\nbase_color = [0.5, 0.6, 0.3]\nmetallic = 0.3\n\
         roughness = 0.5\nanisotropic = 0.7\nsheen = 0.9\nsheen_tint = 1\nsubsurface = 0.3\nclearcoat = 0.8\nclearcoat_gloss = 0.6\n";
    let things = THINGS.replacen("\"white\"", "\"substrate\"", 1).replacen("\"white\"", "\"principled\"", 1);
    let floor = "type = \"matte\"\ncolor = [0.8, 0.7, 0.6]\nsigma = 30";
    judge("other models", scene(&room(THREE, floor, &[more, LAMP, &things].concat()), &[]), 1000);
}

/// A textured lamp; textures that are seen, with texels larger than pixels, and one that only throws its light back: the
/// wall behind the viewer. Both have normal maps, up to 40° off.
#[test]
fn textures() {
    let lamp = format!("{LAMP}texture = \"default_zellige.png\"\n");
    let behind = "[[material]]\nname = \"rug\"\ntype = \"matte\"\ncolor = { texture = \"default_rug.png\" }\n\
         normal_map = \"bumps.png\"\n\
         two_sided = false\n\
         [[mesh]]\nshape = \"plane\"\nsize = 2\nmaterial = \"rug\"\ntranslate = [0, 1, 1]\nrotate = [-90, 0, 0]\n";
    let floor = "type = \"matte\"\ncolor = { texture = \"squares.png\" }\nnormal_map = \"bumps.png\"";
    let text = room(THREE, floor, &[behind, &lamp, THINGS].concat());
    let squares = png([4, 4], |x, y| if (x + y) % 2 == 0 { [230, 60, 40, 255] } else { [40, 90, 200, 255] });
    let bumps = png([4, 4], |x, y| [64 + 42 * x as u8, 64 + 42 * y as u8, 230, 255]);
    let files: [(&str, &[u8]); 4] = [
        ("bumps.png", &bumps),
        ("default_zellige.png", include_bytes!("../../scenes/default_zellige.png")),
        ("default_rug.png", include_bytes!("../../scenes/default_rug.png")),
        ("squares.png", &squares),
    ];
    judge("textures", scene(&text, &files), 1000);
}
