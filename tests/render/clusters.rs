//! Clustered pictures against every light on every pixel.

use crate::support::{
    FIVE_MATERIALS, Rig, assert_close, oracle, ranged_lights, relative_errors, scene, unranged_lights,
};

fn small(text: &str) -> String {
    text.replace("size = [96, 64]", "size = [64, 64]")
}

#[test]
fn a_million_lights_equal_brute_force() {
    let text = small(&format!("{FIVE_MATERIALS}{}", ranged_lights(1 << 20, 0.06)));
    let mut rig = Rig::new(scene(&text));
    let clustered = rig.render();
    assert_eq!(rig.frame.counters().folded, 0, "the lists hold every light");
    let brute = Rig::with(scene(&text), |settings| settings.brute_force = true).render();
    let errors = relative_errors(&clustered, &brute);
    let worst = errors[errors.len() - 1];
    println!("worst {worst:.2e}");
    assert!(worst <= 1e-5, "{worst}");
}

#[test]
fn unranged_lights_are_the_same_in_both() {
    let text = small(&format!("{FIVE_MATERIALS}{}{}", ranged_lights(300, 1.0), unranged_lights(30)));
    let clustered = Rig::new(scene(&text)).render();
    let brute = Rig::with(scene(&text), |settings| settings.brute_force = true).render();
    let errors = relative_errors(&clustered, &brute);
    assert!(errors[errors.len() - 1] <= 1e-5);
}

/// 5,000 lights at one point: every list is over the cap, and the report counts what was folded.
#[test]
fn full_lists_fold_and_count_exactly() {
    let lights = "[[light]]\ntype = \"points\"\ngenerate = { count = 5000, seed = 1, min = [0, 1.5, 1], max = [0, 1.5, 1], \
                  intensity = [1, 1], range = 20.0 }\n";
    let mut rig = Rig::new(scene(&format!("{FIVE_MATERIALS}{lights}")));
    rig.render();
    let counters = rig.frame.counters();
    assert!(counters.clusters > 0);
    assert_eq!(counters.longest, 5000);
    assert_eq!(counters.overflowed, counters.occupied);
    assert_eq!(counters.entries, counters.occupied * 1024);
    assert_eq!(counters.folded, counters.occupied * (5000 - 1024));
}

/// More clusters and longer lists than a frame starts with room for: it grows, and nothing is lost.
#[test]
fn room_for_lists_grows_within_the_frame() {
    let text = small(&format!("{FIVE_MATERIALS}{}", ranged_lights(2000, 20.0)))
        .replace("[render]", "[render]\nmax_lights_per_cluster = 2048");
    let mut rig = Rig::new(scene(&text));
    let first = rig.render();
    assert_eq!(rig.frame.counters().folded, 0);
    assert_eq!(first, rig.render());
    let brute = Rig::with(scene(&text), |settings| settings.brute_force = true).render();
    let errors = relative_errors(&first, &brute);
    assert!(errors[errors.len() - 1] <= 1e-5);
}

#[test]
fn pairs_are_counted() {
    let mut rig =
        Rig::new(scene(&format!("{FIVE_MATERIALS}{}{}", ranged_lights(500, 1.0), unranged_lights(7))));
    rig.render();
    let pairs = rig.frame.pairs().unwrap();
    let counts = rig.aov(amas::passes::aov::Quantity::LightCount);
    let evaluated: f64 = counts.iter().map(|v| f64::from(v[0])).sum();
    assert_eq!(pairs.evaluated as f64, evaluated);
    let covered = counts.iter().filter(|v| v[3] > 0.0).count() as u64;
    assert!(pairs.useful >= 7 * covered && pairs.useful <= pairs.evaluated, "{pairs:?}");
}

/// lavapipe ends a shader's loops after 65,535 iterations in all, silently.
#[test]
fn more_lights_than_a_loop_may_have_iterations() {
    let tiny = |text: &str| text.replace("size = [96, 64]", "size = [16, 16]");
    let lights = "[[light]]\ntype = \"points\"\ngenerate = { count = 1048576, seed = 1, min = [0, 1.5, 1], \
                  max = [0, 1.5, 1], intensity = [1, 1], range = 20.0 }\n";
    let mut rig = Rig::new(scene(&tiny(&format!("{FIVE_MATERIALS}{lights}"))));
    rig.render();
    let counters = rig.frame.counters();
    assert_eq!(counters.longest, 1 << 20);
    assert_eq!(counters.folded, counters.occupied * ((1 << 20) - 1024));

    let mut rig =
        Rig::with(scene(&tiny(&format!("{FIVE_MATERIALS}{}", unranged_lights(70_000)))), |settings| {
            settings.light_error = 0.0;
        });
    assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 1e-4);
}
