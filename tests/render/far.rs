//! A scene far from the world's origin.

use crate::support::{FIVE_MATERIALS, Rig, assert_close, oracle, ranged_lights, scene, unranged_lights};
use amas::passes::aov::Quantity;

/// The device moves the scene to its own origin, so it errs no more there than anywhere; positions are reported where
/// they are.
#[test]
fn a_hundred_kilometres_out() {
    let text = format!("{FIVE_MATERIALS}{}{}", ranged_lights(300, 1.0), unranged_lights(5))
        .replace(
            "position = [0, 1.5, 5]\ntarget = [0, 0.5, 0]",
            "position = [1e5, 1.5, 5]\ntarget = [1e5, 0.5, 0]",
        )
        .replace("size = 8", "size = 8\ntranslate = [1e5, 0, 0]")
        .replace("translate = [-1.5,", "translate = [99998.5,")
        .replace("translate = [-0.75,", "translate = [99999.25,")
        .replace("translate = [0,", "translate = [100000,")
        .replace("translate = [0.75,", "translate = [100000.75,")
        .replace("translate = [1.5,", "translate = [100001.5,")
        .replace("min = [-4,", "min = [99996,")
        .replace("max = [4,", "max = [100004,");
    let mut rig = Rig::new(scene(&text));
    assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 1e-3);
    let seen = rig.aov(Quantity::Position);
    assert!(seen.iter().all(|p| p[3] == 0.0 || (p[0] - 1e5).abs() < 5.0));
}
