//! Lights that move: closed forms of time.

use crate::{load, try_load};
use glam::Vec3;

fn at(scene: &amas::Scene, t: f64) -> Vec<Vec3> {
    scene.point_lights_at(t).iter().map(|light| light.position).collect()
}

fn near(a: Vec3, b: Vec3) {
    assert!((a - b).abs().max_element() < 1e-6, "{a} is not {b}");
}

#[test]
fn a_group_orbits_its_axis_and_the_others_stand() {
    let light = "[[light]]\ntype = \"point\"\nposition = [3, 5, 0]\nintensity = [1, 2, 3]\nrange = 4\n";
    let orbit = "animate = { type = \"orbit\", center = [1, 0, 0], period = 8 }\n";
    let scene = load(&format!("{light}{light}{orbit}{light}"), &[]);
    assert_eq!(scene.motions.len(), 1);
    // Counter-clockwise about +y: x goes to −z.
    for (t, x, z) in [(0.0, 3.0, 0.0), (2.0, 1.0, -2.0), (4.0, -1.0, 0.0), (6.0, 1.0, 2.0), (8e6, 3.0, 0.0)] {
        let places = at(&scene, t);
        near(places[1], Vec3::new(x, 5.0, z));
        assert_eq!([places[0], places[2]], [Vec3::new(3.0, 5.0, 0.0); 2]);
    }
    let (then, now) = (scene.point_lights[1], scene.point_lights_at(3.0)[1]);
    assert_eq!((then.intensity, then.range), (now.intensity, now.range));
}

#[test]
fn lights_drift_at_their_speed_and_stay_within_their_walls() {
    let scene = load(
        "[[light]]\ntype = \"points\"\ngenerate = { count = 2000, min = [0, 1, 0], max = [4, 2, 4], intensity = [1, 1] }\n\
         animate = { type = \"drift\", speed = 0.5, seed = 7 }\n",
        &[],
    );
    let (start, soon) = (at(&scene, 0.0), at(&scene, 0.01));
    assert_eq!(start, scene.point_lights.iter().map(|light| light.position).collect::<Vec<_>>());
    let mut mean = Vec3::ZERO;
    let mut straight = 0;
    for (a, b) in start.iter().zip(&soon) {
        let step = b - a;
        assert!(step.length() < 0.005_001);
        // All but those that meet a wall on the way.
        straight += usize::from((step.length() - 0.005).abs() < 1e-6);
        mean += step / 0.005;
    }
    assert!(straight > 1900, "{straight}");
    // Directions are uniform: each mean coordinate has a standard deviation of (1/3 / 2000)^½ = 0.013.
    assert!((mean / 2000.0).abs().max_element() < 0.055, "{mean}");
    for t in [1.0, 100.0, 1e9, 1e300] {
        for p in at(&scene, t) {
            assert!(
                p.cmpge(Vec3::new(-1e-6, 1.0 - 1e-6, -1e-6)).all()
                    && p.cmple(Vec3::new(4.001, 2.001, 4.001)).all()
            );
        }
    }
    assert_eq!(at(&scene, 3.7), at(&scene, 3.7));
}

#[test]
fn a_bad_motion_is_named() {
    let light = "[[light]]\ntype = \"point\"\nposition = [3, 5, 0]\nintensity = [1, 2, 3]\n";
    for (animate, cause) in [
        ("{ type = \"orbi\", center = [0, 0, 0], period = 1 }", "orbit"),
        ("{ type = \"orbit\", period = 1 }", "center"),
        ("{ type = \"orbit\", center = [0, 0, 0], period = 0 }", "period"),
        ("{ type = \"orbit\", center = [0, 0, 0], axis = [0, 0, 0], period = 1 }", "axis"),
        ("{ type = \"drift\", speed = 1 }", "one place"),
        ("{ type = \"drift\", speed = 1, period = 2 }", "period"),
        ("3", "animate"),
    ] {
        let error = try_load(&format!("{light}animate = {animate}\n"), &[], &[]).unwrap_err().to_string();
        assert!(error.contains("test.toml:9") && error.contains(cause), "{error}");
    }
}
