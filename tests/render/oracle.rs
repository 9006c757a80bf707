//! Pictures against the double-precision oracle.

use crate::support::{
    FIVE_MATERIALS, Rig, assert_close, oracle, ranged_lights, relative_errors, scene, unranged_lights,
};

#[test]
fn all_materials_under_ranged_and_unranged_lights() {
    let mut rig =
        Rig::new(scene(&format!("{FIVE_MATERIALS}{}{}", ranged_lights(500, 1.0), unranged_lights(20))));
    let expected = oracle(&rig.scene);
    let picture = rig.render();
    assert_close(&picture, &expected, 0.99, 1e-4);
    let mean = |image: &amas::HdrImage| image.pixels.iter().flatten().map(|&v| f64::from(v)).sum::<f64>();
    assert!((mean(&picture) / mean(&expected) - 1.0).abs() < 1e-4, "mean bias");
}

#[test]
fn one_kind_of_light_at_a_time() {
    for lights in [ranged_lights(200, 2.0), unranged_lights(50)] {
        let mut rig = Rig::new(scene(&format!("{FIVE_MATERIALS}{lights}")));
        assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 1e-4);
    }
}

#[test]
fn samples_converge_to_the_oracle_s_mean() {
    let text = format!("{FIVE_MATERIALS}{}", ranged_lights(200, 2.0))
        .replace("size = [96, 64]", "size = [48, 32]\nsamples = 32");
    let mut rig = Rig::new(scene(&text));
    let errors = relative_errors(&rig.render(), &oracle(&rig.scene));
    // Two different sets of 32 points a pixel: edges differ by about a step of 1/32 of the contrast.
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    assert!(mean < 0.02, "{mean}");
}

/// A light far below the floor, on it, and at the eye; the darkest and brightest intensities that a scene may have.
#[test]
fn extreme_lights_leave_every_value_finite() {
    let lights = r#"
[[light]]
type = "point"
position = [0, 0, 0.5]
intensity = [1e18, 1e18, 1e18]
[[light]]
type = "point"
position = [0.1, 0, 0.5]
intensity = [1e18, 0, 1e-30]
range = 1e-6
[[light]]
type = "point"
position = [0, 1.5, 5]
intensity = [1e-38, 1, 1]
range = 1e6
"#;
    for samples in [1, 3] {
        let text = format!("{FIVE_MATERIALS}{lights}")
            .replace("size = [96, 64]", &format!("size = [96, 64]\nsamples = {samples}"));
        Rig::new(scene(&text)).render();
    }
}
