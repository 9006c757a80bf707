//! Laws of light transport: closed sphere, furnaces, energy.

use std::f64::consts::PI;

use amas::shared::VirtualLight;
use amas::virtual_lights::LightSet;
use amas::virtual_lights::octahedral::unpack_normal;
use glam::DVec3;

use crate::{color, expect, scene, sets, sum};

/// A sphere of radius 1 and albedo ½ about a light of intensity π.
fn sphere(bounces: u32) -> amas::scene::Scene {
    let text = format!(
        "[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [{PI}, {PI}, {PI}]\n\
         [[mesh]]\nshape = \"sphere\"\nradius = 1\nsegments = 192\nmaterial = \"m\"\n"
    );
    scene(0.5, bounces, &text)
}

#[test]
fn flux_halves_at_each_bounce_of_a_closed_sphere() {
    let sets = sets(&sphere(6), 16_384, 12);
    for depth in 1..=6 {
        let flux: Vec<f64> = sets.iter().map(|set| PI * sum(set, |l| l.extra == depth).x).collect();
        let want = 4.0 * PI * PI * 0.5_f64.powi(depth as i32);
        expect(&format!("depth {depth}"), &flux, want, 0.02, 4e-4);
    }
}

/// Irradiance of bounced lights at a place.
fn irradiance(set: &LightSet, place: DVec3, normal: DVec3) -> f64 {
    let of = |light: &VirtualLight| {
        let to_light = DVec3::from_array(light.position.map(f64::from)) - place;
        let squared = to_light.length_squared();
        let wi = to_light / squared.sqrt();
        let cosines = normal.dot(wi).max(0.0) * (-unpack_normal(light.normal).dot(wi)).max(0.0);
        color(light).x * cosines / squared
    };
    set.bounced.iter().map(of).sum()
}

/// ½ from the point light, half of that again at each bounce.
#[test]
fn radiance_in_a_closed_sphere() {
    let sets = sets(&sphere(10), 16_384, 12);
    for place in [DVec3::X, DVec3::new(0.48, -0.6, 0.64), DVec3::NEG_Y] {
        let radiance = |set: &LightSet| 0.5 + irradiance(set, place, -place) * 0.5 / PI;
        let radiance: Vec<f64> = sets.iter().map(radiance).collect();
        expect("radiance", &radiance, 1.0 - 0.5_f64.powi(11), 2e-3, 1e-3);
    }
}

/// Under a white sky white surfaces shine as it does: the lights' colours sum up to the area that is not hidden.
#[test]
fn furnace() {
    let floor = "[[mesh]]\nshape = \"plane\"\nsize = 4\nmaterial = \"m\"\n";
    let mut text = floor.to_owned();
    let white = |text: &str, bounces| {
        let mut scene = scene(1.0, bounces, text);
        scene.render.background = [1.0; 3];
        scene
    };
    let total =
        |scene: &_| -> Vec<f64> { sets(scene, 16_384, 12).iter().map(|set| sum(set, |_| true).y).collect() };
    expect("floor", &total(&white(&text, 1)), 2.0 * 16.0, 5e-3, 1e-5);
    text.push_str(
        "[[mesh]]\nshape = \"box\"\nsize = 1\nmaterial = \"m\"\ntranslate = [0, 1.1, 0]\nrotate = [10, 20, 30]\n",
    );
    expect("floor and box", &total(&white(&text, 64)), 2.0 * 16.0 + 6.0, 5e-3, 1e-4);
    // A luminaire that is seen hides the sky: all of it from a plate as large as the floor, close above.
    text.push_str(
        "[[light]]\ntype = \"rect\"\ncenter = [0, 3, 0]\nu = [0, 0, 9]\nv = [9, 0, 0]\nradiance = [0, 0, 0]\n",
    );
    let shaded = total(&white(&text, 1)).iter().sum::<f64>() / 12.0;
    assert!(shaded < 0.75 * 38.0, "{shaded}");
}

const FOUR: [(&str, f64); 4] = [
    ("type = \"matte\"\ncolor = [0.9, 0.9, 0.9]\nsigma = 30", 0.7),
    ("type = \"plastic\"\ndiffuse = [0.8, 0.8, 0.8]\nspecular = [0.2, 0.2, 0.2]\nroughness = 0.3", 0.8),
    ("type = \"substrate\"\ndiffuse = [0.9, 0.9, 0.9]\nspecular = [0.1, 0.1, 0.1]\nroughness = 0.4", 0.5),
    ("type = \"principled\"\nbase_color = [0.8, 0.8, 0.8]\nroughness = 0.6\nmetallic = 0.2", 0.5),
];

/// What arrives at each depth is less than at the one before, but not much.
#[test]
fn energy_is_not_gained() {
    for (material, least) in FOUR {
        let text = format!(
            "[[material]]\nname = \"x\"\n{material}\n[[mesh]]\nshape = \"box\"\nsize = 2\nmaterial = \"x\"\n\
             [[light]]\ntype = \"point\"\nposition = [0.1, 0.2, 0.3]\nintensity = [1, 1, 1]\n"
        );
        let sets = sets(&scene(0.5, 6, &text), 60_000, 2);
        let at = |depth| sets.iter().map(|set| sum(set, |l| l.extra == depth).x).sum::<f64>();
        for depth in 1..6 {
            let ratio = at(depth + 1) / at(depth);
            println!("{material}, {depth}: {ratio:.3}");
            assert!((least..1.01).contains(&ratio), "{material}, {depth}: {ratio}");
        }
    }
}

/// Of what a source gives to a metal box, black walls inside it take no more than all, and most of it.
#[test]
fn a_black_body_in_a_metal_box_takes_what_there_is() {
    let text = "[[material]]\nname = \"x\"\ntype = \"metal\"\npreset = \"silver\"\nroughness = 0.3\n\
         [[mesh]]\nshape = \"box\"\nsize = 2\nmaterial = \"x\"\n\
         [[mesh]]\nshape = \"sphere\"\nradius = 0.6\nmaterial = \"m\"\n\
         [[light]]\ntype = \"point\"\nposition = [0.8, 0.8, 0.8]\nintensity = [1, 1, 1]\n";
    // An albedo of 1e-3: the lights' sum over it is the flux that arrives.
    for set in sets(&scene(1e-3, 64, text), 20_000, 3) {
        let taken = sum(&set, |_| true).y * PI / 1e-3 / (4.0 * PI);
        println!("{taken:.4}");
        assert!((0.6..1.0).contains(&taken), "{taken}");
    }
}

/// The same bytes for a seed on any number of threads, others for another seed; about as many lights as wanted.
#[test]
fn seeds_and_counts() {
    let scene = sphere(3);
    let traced = |threads, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| amas::virtual_lights::Tracer::new(&scene, glam::Vec3::ZERO).trace(20_000, seed))
    };
    assert_eq!(traced(1, 5), traced(3, 5));
    assert_ne!(traced(1, 5).bounced, traced(1, 6).bounced);
    for count in [0_usize, 1, 16, 1000, 100_000] {
        for set in sets(&scene, count, 20) {
            let found = set.bounced.len();
            assert!(count < 16 || (count / 4..=count).contains(&found), "{found} of {count}");
            assert!(count < 100_000 || found > 97 * count / 100, "{found} of {count}");
        }
    }
    // 20,000 lights on 4π m²: neighbours are some 1/√(n/area) = 2.5 cm apart.
    let spacing = traced(2, 1).spacing;
    assert!((0.01..0.04).contains(&spacing), "{spacing}");
}
