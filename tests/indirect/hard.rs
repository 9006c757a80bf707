//! Scenes that have little to gather, or what numbers break on: all is finite, and dark where it must be.

use amas::scene::{AreaShape, Scene};
use glam::Vec3;

use crate::support::{LAMP, MATTE, Rig, THINGS, room, scene};

const SMALL: &str = "size = [16, 12]\nindirect = { vpls = 256, bounces = 3 }";
const LIGHT: &str = "[[light]]\ntype = \"point\"\nposition = [0.35, 0.4, -0.1]\nintensity = [1, 1, 1]\n";

/// Two rounds of what must stay black.
fn dark(what: &str, scene: Scene) {
    let mut rig = Rig::new(scene);
    rig.refine(2);
    assert_eq!(brightest(&rig), 0.0, "{what}");
    assert_eq!(rig.frame.gathered_error().unwrap(), Some(0.0), "{what}");
}

fn brightest(rig: &Rig) -> f32 {
    rig.gathered().pixels.iter().flatten().fold(0.0, |most, value| most.max(value.abs()))
}

fn room_of(more: &str) -> String {
    room(SMALL, MATTE, more)
}

#[test]
fn no_light() {
    dark("no light", scene(&room_of(THINGS), &[]));
    let mut black = room_of(&[LAMP, THINGS].concat());
    for color in ["[0.75, 0.72, 0.68]", "[0.62, 0.1, 0.07]", "[0.1, 0.2, 0.55]", "[0.7, 0.7, 0.7]"] {
        assert!(black.contains(color));
        black = black.replace(color, "[0, 0, 0]");
    }
    dark("black", scene(&black, &[]));
}

#[test]
fn no_area() {
    let mut scene = scene(&room_of(&[LAMP, THINGS].concat()), &[]);
    scene.area_lights[0].shape = AreaShape::Rect { center: Vec3::new(0.0, 1.9, 0.0), u: Vec3::X, v: Vec3::X };
    dark("no area", scene);
}

/// A light in a closed box, which hangs in the room. Around the box nothing is lit by a share of 1e-4 of what it is inside,
/// where the walls are 0.3 m from the light.
#[test]
fn closed_box() {
    let things = THINGS.replace("[0.35, 0.3, -0.1]", "[0.35, 0.5, -0.1]");
    let light = LIGHT.replace("[0.35, 0.4, -0.1]", "[0.35, 0.5, -0.1]");
    let mut rig = Rig::new(scene(&room_of(&[&light, things.as_str()].concat()), &[]));
    rig.refine(4);
    let inside = 0.75 / (std::f32::consts::PI * 0.3 * 0.3);
    let leak = brightest(&rig);
    println!("at most {leak:.1e} around the box, {inside:.2} in it");
    assert!(leak <= 1e-4 * inside, "{leak} around the box, {inside} in it");
}

#[test]
fn nothing_in_view() {
    let text = room_of(&[LAMP, THINGS].concat()).replace("target = [0, 0.9, 0]", "target = [0, 0.9, 9]");
    dark("nothing in view", scene(&text, &[]));
}

/// Direct light alone: no bounce brings any.
#[test]
fn no_bounces() {
    let text = room_of(&[LAMP, THINGS].concat()).replace("bounces = 3", "bounces = 0");
    dark("no bounces", scene(&text, &[]));
}

/// All virtual lights lie on a millimetre of floor, and the light is on it, too.
#[test]
fn one_triangle() {
    for height in ["1e-3", "0"] {
        let text = room_of("")
            .replace("size = 2\n", "size = 1e-3\n")
            .replace("[0, 1, 3.2]", "[0, 0.002, 0.002]")
            .replace(
                "target = [0, 0.9, 0]\nvertical_fov = 42\nnear = 0.01",
                "target = [0, 0, 0]\nvertical_fov = 42\nnear = 1e-5",
            );
        let light =
            format!("[[light]]\ntype = \"point\"\nposition = [0, {height}, 0]\nintensity = [1e3, 1, 1]\n");
        let mut rig = Rig::new(scene(&[&text, light.as_str()].concat(), &[]));
        rig.refine(2);
        rig.gathered();
        rig.picture();
    }
}

/// The eye a tenth of a millimetre off a wall, lights on walls and edges; then other sizes, and hardly any lights.
#[test]
fn close_and_small() {
    let on_walls = "[[light]]\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = [1, 1, 1]\n\
         [[light]]\ntype = \"point\"\nposition = [-1, 0, -1]\nintensity = [1, 1, 1]\nrange = 2\n";
    let text = room_of(&[LAMP, on_walls, THINGS].concat())
        .replace(
            "position = [0, 1, 3.2]\ntarget = [0, 0.9, 0]",
            "position = [-0.9999, 1, 0.5]\ntarget = [-0.9, 0.9, 0]",
        )
        .replace("near = 0.01", "near = 1e-5");
    let mut rig = Rig::new(scene(&text, &[]));
    rig.refine(2);
    assert!(crate::support::mean(&rig.gathered()) > 0.0);
    for size in [[1, 1], [1, 7], [33, 5], [5, 19]] {
        for vpls in [1, 17, 256] {
            rig.resize(size);
            rig.scene.render.vpls = vpls;
            rig.refine(2);
            let picture = rig.picture();
            assert_eq!([picture.width, picture.height], size);
            assert!(rig.frame.gathered_error().unwrap().unwrap().is_finite());
        }
    }
}
