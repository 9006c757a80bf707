//! Lights that move: at any time the picture is that of lights that stand there.

use crate::support::{FIVE_MATERIALS, Rig, ranged_lights, scene, unranged_lights};
use amas::{HdrImage, Scene};

const ORBIT: &str = "animate = { type = \"orbit\", center = [0, 1, 0], axis = [1, 2, 0], period = 3 }\n";
const DRIFT: &str = "animate = { type = \"drift\", speed = 0.7, seed = 3 }\n";

fn at(scene: &Scene, t: f64) -> HdrImage {
    let standing = Scene { point_lights: scene.point_lights_at(t), motions: vec![], ..scene.clone() };
    Rig::new(standing).render()
}

/// Lights that move keep the order of the middle of an interval, so sums may round differently: by half a unit in the last
/// place for each light of a list, had they all the same sign of error.
fn assert_same_light(picture: &HdrImage, standing: &HdrImage, t: f64) {
    for (a, b) in picture.pixels.iter().flatten().zip(standing.pixels.iter().flatten()) {
        assert!((a - b).abs() <= 64.0 * f32::EPSILON * b, "t = {t}: {a} is not {b}");
    }
}

#[test]
fn a_moving_light_lights_as_one_that_stands() {
    let lights = [ranged_lights(3000, 0.8), DRIFT.into(), unranged_lights(20), ORBIT.into()].concat();
    let scene = scene(&format!("{FIVE_MATERIALS}{lights}"));
    let mut rig = Rig::new(scene.clone());
    let mut seen = Vec::new();
    // Back and forth: no picture depends on those before it.
    for t in [0.0, 0.4, 7.25, 0.4] {
        let picture = rig.render_at(t);
        assert_same_light(&picture, &at(&scene, t), t);
        seen.push(picture);
    }
    assert!(seen[0] != seen[1] && seen[1] == seen[3]);
}

#[test]
fn the_moving_of_lights_is_timed_as_a_pass() {
    let names = |text: String| Rig::new(scene(&text)).passes();
    let standing = names(format!("{FIVE_MATERIALS}{}", ranged_lights(10, 2.0)));
    let moving = names(format!("{FIVE_MATERIALS}{}{DRIFT}", ranged_lights(10, 2.0)));
    assert_eq!(moving[0], "lights");
    assert_eq!(moving[1..], standing);
}
