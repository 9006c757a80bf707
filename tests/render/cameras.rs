//! Cameras against the oracle's rays.

use crate::support::{FIVE_MATERIALS, Rig, assert_close, oracle, scene, unranged_lights};

fn check(camera: &str) {
    let text =
        FIVE_MATERIALS.replace("position = [0, 1.5, 5]\ntarget = [0, 0.5, 0]\nvertical_fov = 40", camera);
    assert_ne!(text, FIVE_MATERIALS);
    let mut rig = Rig::new(scene(&format!("{text}{}", unranged_lights(4))));
    assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 1e-4);
}

#[test]
fn perspective() {
    check("position = [2, 2.5, 4]\ntarget = [0, 0.5, 0.2]\nvertical_fov = 70\nup = [0.2, 1, 0.1]");
    check("position = [0, 1.5, 5]\ntarget = [0, 0.5, 0]\nvertical_fov = 40\nnear = 4.5\nfar = 5.6");
    check("position = [0, 60, 0.01]\ntarget = [0, 0, 0]\nvertical_fov = 4\nnear = 50");
}

#[test]
fn orthographic() {
    check("position = [1, 2, 4]\ntarget = [0, 0.4, 0]\northographic_height = 3");
    check(
        "position = [0, 5, 0]\ntarget = [0, 0, 0]\nup = [1, 0, 0]\northographic_height = 2\nnear = 4.3\nfar = 4.9",
    );
}
