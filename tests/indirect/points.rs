//! Point lights with shadows, with a range and without, alone and with what they light.

use amas::reference::{Integrator, Options};

use crate::support::{MATTE, Rig, THINGS, Truth, judge, judge_by, room, scene};

const LIGHTS: &str = "[[light]]\ntype = \"points\"\ngenerate = { count = 60, seed = 3, min = [-0.9, 0.1, -0.9], \
     max = [0.9, 1.9, 0.9], intensity = [0.01, 0.2], range = 1.2 }\n\
     [[light]]\ntype = \"points\"\ngenerate = { count = 20, seed = 4, min = [-0.9, 0.1, -0.9], max = [0.9, 1.9, 0.9], \
     intensity = [0.01, 0.1] }\n";

fn text(render: &str) -> String {
    room(&format!("size = [32, 24]\n{render}"), MATTE, &[LIGHTS, THINGS].concat())
}

/// The oracle's sum over all of them is exact.
#[test]
fn shadows_alone() {
    let scene = scene(&text(""), &[]);
    let options = Options { integrator: Integrator::Shadowed, ..Options::of_scene(&scene) };
    let truth = Truth::new(&scene, &options);
    assert_eq!(truth.variance, 0.0);
    let rig = Rig::new(scene);
    assert!(rig.frame.gathers().points && !rig.frame.gathers().indirect);
    judge_by("points", rig, &truth);
}

#[test]
fn with_indirect_light() {
    let scene = scene(&text("indirect = { vpls = 2048, bounces = 3 }"), &[]);
    let rig = judge("points and indirect", scene, 1000);
    // Their own light, apart from what the room makes of it.
    let options = Options { integrator: Integrator::Shadowed, ..Options::of_scene(&rig.scene) };
    let truth = Truth::new(&rig.scene, &options);
    let [_, points] = rig.frame.gathered_light().unwrap().unwrap();
    let off = crate::support::mean(&points) / crate::support::mean(&truth.image) - 1.0;
    println!("direct off by {:+.2} %", 100.0 * off);
    assert!(off.abs() <= 0.01, "{off}");
}
