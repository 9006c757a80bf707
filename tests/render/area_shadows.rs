//! Shadows of area lights against the oracle and against their outlines.

use crate::support::{Rig, scene_with};
use amas::HdrImage;
use amas::passes::aov::Quantity;
use amas::reference::{self, Integrator, Options};
use image::{ImageFormat, Luma};
use std::io::Cursor;

/// A floor that fills the view; whatever hides the light hangs above the view.
const FLOOR: &str = r#"
[[camera]]
name = "c"
position = [0, 0.8, 0.8]
target = [0, 0, 0]
orthographic_height = 1
[[material]]
name = "black"
type = "matte"
color = [0, 0, 0]
[[mesh]]
shape = "plane"
size = 20
material = "floor"
"#;
const MATTE: &str = "[[material]]\nname = \"floor\"\ntype = \"matte\"\ncolor = [0.5, 0.6, 0.7]\n";
const PLASTIC: &str =
    "[[material]]\nname = \"floor\"\ntype = \"plastic\"\ndiffuse = [0.3, 0.2, 0.1]\nalpha = 0.3\n";
const METAL: &str = "[[material]]\nname = \"floor\"\ntype = \"metal\"\npreset = \"gold\"\nalpha = 0.4\n";
/// Level, half its height above the floor: see [`lit`].
const OCCLUDER: &str =
    "[[mesh]]\nshape = \"plane\"\nsize = [0.6, 0.4]\ntranslate = [0.1, 1.5, 0]\nmaterial = \"black\"\n";
const HIGH: &str = "[[light]]\ntype = \"rect\"\ncenter = [0.1, 3, 0]\nu = [0.25, 0, 0]\nv = [0, 0, 0.15]\nradiance = [8, 7, 6]\nvisible = false\n";
const OTHERS: &str = "[[light]]\ntype = \"disk\"\ncenter = [-0.8, 2.8, -1]\nnormal = [0.2, -1, 0.3]\nradius = 0.3\nradiance = [6, 6, 9]\nvisible = false\n\
    [[light]]\ntype = \"line\"\na = [-0.6, 2.4, -1.2]\nb = [0.9, 2.6, -1.2]\nradius = 0.04\nradiance = [9, 9, 9]\nvisible = false\n";

fn text(samples: u32, shadows: bool, rest: &[&str]) -> String {
    format!("[render]\nsize = [24, 16]\nsamples = {samples}\nshadows = {shadows}\n{FLOOR}{}", rest.concat())
}

fn rig(samples: u32, shadows: bool, rest: &[&str]) -> Rig {
    Rig::new(scene_with(&text(samples, shadows, rest), &[]))
}

fn truth(rig: &Rig, spp: u32) -> HdrImage {
    let scene = &rig.scene;
    let options =
        Options { integrator: Integrator::Shadowed, spp, tolerance: 1e-3, ..Options::of_scene(scene) };
    reference::render(scene, &scene.cameras[0], &options).unwrap().image
}

/// Root mean squared difference over the mean, and relative difference of the means.
fn differences(a: &HdrImage, b: &HdrImage) -> [f64; 2] {
    let values = |image: &HdrImage| image.pixels.iter().flatten().map(|&v| f64::from(v)).collect::<Vec<_>>();
    let (a, b) = (values(a), values(b));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let squares: Vec<f64> = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).collect();
    [mean(&squares).sqrt() / mean(&b), mean(&a) / mean(&b) - 1.0]
}

/// Slope of the error over the number of samples, both in logarithms, by least squares.
fn slope(errors: &[(f64, f64)]) -> f64 {
    let points: Vec<[f64; 2]> = errors.iter().map(|(n, e)| [n.ln(), e.ln()]).collect();
    let mean = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / points.len() as f64);
    let sum = |i: usize| points.iter().map(|p| (p[0] - mean[0]) * (p[i] - mean[i])).sum::<f64>();
    sum(1) / sum(0)
}

#[test]
fn shadows_converge_to_the_oracle_s() {
    for (name, floor) in [("matte", MATTE), ("plastic", PLASTIC), ("metal", METAL)] {
        let rest = [floor, OCCLUDER, HIGH, OTHERS];
        let expected = truth(&rig(1, true, &rest), 16);
        let mut errors = vec![];
        let mut bias = 0.0;
        for samples in [4, 16, 64, 256] {
            let [rmse, off] = differences(&rig(samples, true, &rest).render(), &expected);
            println!("{name}, {samples} samples: rmse {rmse:.2e}, bias {off:+.2e}");
            errors.push((f64::from(samples), rmse));
            bias = off;
        }
        let slope = slope(&errors);
        println!("{name}: slope {slope:.3}");
        assert!((-1.1..=-0.35).contains(&slope), "{name}: slope {slope}");
        assert!(bias.abs() <= 5e-3, "{name}: bias {bias}");
    }
}

/// What of the light a level sheet hides from a place on the floor, from their outlines: lit, in part, dark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lit {
    All,
    Part,
    None,
}

/// [`HIGH`] behind [`OCCLUDER`]: seen from the floor, the light's outline in the sheet's plane is half way.
fn lit([x, _, z, _]: [f32; 4]) -> Lit {
    let image = |p: f32, center: f32, half: f32| [0.5 * (p + center - half), 0.5 * (p + center + half)];
    let sides = [(image(x, 0.1, 0.25), [-0.2, 0.4]), (image(z, 0.0, 0.15), [-0.2, 0.2])];
    let margin = 1e-4;
    if sides.iter().any(|(light, sheet)| light[1] < sheet[0] - margin || light[0] > sheet[1] + margin) {
        Lit::All
    } else if sides.iter().all(|(light, sheet)| light[0] > sheet[0] + margin && light[1] < sheet[1] - margin)
    {
        Lit::None
    } else {
        Lit::Part
    }
}

#[test]
fn lit_places_have_no_noise_and_dark_ones_no_light() {
    for floor in [MATTE, PLASTIC, METAL] {
        let free = rig(1, false, &[floor, OCCLUDER, HIGH]).render();
        let mut rig = rig(1, true, &[floor, OCCLUDER, HIGH]);
        let picture = rig.render();
        let places = rig.aov(Quantity::Position);
        let mut counts = [0; 3];
        for ((got, free), place) in picture.pixels.iter().zip(&free.pixels).zip(places) {
            let lit = lit(place);
            counts[lit as usize] += 1;
            for (got, free) in got.iter().zip(free) {
                let close = (got - free).abs() <= 1e-6 * free;
                match lit {
                    Lit::All => assert!(close, "{got} instead of {free} at {place:?}"),
                    Lit::None => assert_eq!(*got, 0.0, "at {place:?}"),
                    Lit::Part => assert!(*got <= free * (1.0 + 1e-6), "{got} beyond {free} at {place:?}"),
                }
            }
        }
        println!("lit, in part, dark: {counts:?}");
        assert!(counts.iter().all(|&count| count > 10), "{counts:?}");
    }
}

#[test]
fn the_same_bytes_on_every_run() {
    let picture = || rig(3, true, &[PLASTIC, OCCLUDER, HIGH, OTHERS]).render();
    assert!(picture() == picture());
}

/// A sheet of which the mask leaves stripes.
#[test]
fn masks_let_light_through() {
    let mut png = Vec::new();
    image::GrayImage::from_fn(8, 8, |x, _| Luma([if x % 4 < 2 { 255 } else { 0 }]))
        .write_to(&mut Cursor::new(&mut png), ImageFormat::Png)
        .unwrap();
    let sheet = "[[material]]\nname = \"lace\"\ntype = \"matte\"\ncolor = [0, 0, 0]\nalpha_mask = \"m.png\"\n\
        [[mesh]]\nshape = \"plane\"\nsize = [0.8, 0.8]\ntranslate = [0.1, 1.5, 0]\nmaterial = \"lace\"\n";
    let text = text(64, true, &[MATTE, sheet, HIGH]);
    let mut rig = Rig::new(scene_with(&text, &[("m.png", &png)]));
    let expected = truth(&rig, 16);
    let [rmse, bias] = differences(&rig.render(), &expected);
    println!("masked: rmse {rmse:.2e}, bias {bias:+.2e}");
    assert!(rmse < 0.15 && bias.abs() < 5e-3, "rmse {rmse}, bias {bias}");
    let solid = text.replace("alpha_mask = \"m.png\"\n", "");
    let mut solid = Rig::new(scene_with(&solid, &[]));
    let expected_solid = truth(&solid, 4);
    let [_, brighter] = differences(&expected, &expected_solid);
    assert!(brighter > 0.05, "the mask matters: {brighter}");
    let [_, bias] = differences(&solid.render(), &expected_solid);
    assert!(bias.abs() < 2e-2, "bias {bias}");
}

/// A luminaire that is seen hides what is behind it, and one that is not seen does not.
#[test]
fn luminaires_hide_lights() {
    let panel = |visible: bool| {
        format!(
            "[[light]]\ntype = \"rect\"\ncenter = [0.1, 1.5, 0]\nu = [0, 0, 0.2]\nv = [0.3, 0, 0]\nradiance = [5, 5, 5]\n\
             visible = {visible}\n"
        )
    };
    let free = rig(1, false, &[MATTE, HIGH]).render();
    let passed = rig(1, true, &[MATTE, HIGH, &panel(false)]).render();
    let mut hides = rig(1, true, &[MATTE, HIGH, &panel(true)]);
    let hidden = hides.render();
    let mut dark = 0;
    for (i, place) in hides.aov(Quantity::Position).into_iter().enumerate() {
        let close =
            |a: [f32; 3]| (0..3).all(|c| (a[c] - free.pixels[i][c]).abs() <= 1e-6 * free.pixels[i][c]);
        assert!(close(passed.pixels[i]), "{:?} instead of {:?}", passed.pixels[i], free.pixels[i]);
        match lit(place) {
            Lit::All => assert!(close(hidden.pixels[i])),
            Lit::None => {
                dark += 1;
                assert_eq!(hidden.pixels[i], [0.0; 3], "at {place:?}");
            }
            Lit::Part => {}
        }
    }
    assert!(dark > 10);
}
