//! Flux of every kind of emitter, in closed form, by what walls around it get.

use std::f64::consts::PI;

use amas::scene::{Scene, Texels, Texture};
use glam::DVec3;

use crate::{color, expect, expect_rgb, scene, sets, sum};

const RADIANCE: DVec3 = DVec3::new(3.0, 2.0, 0.5);

/// Lights in a closed box of albedo ½, four metres wide.
fn boxed(lights: &str) -> Scene {
    let lights = lights.replace("RADIANCE", "radiance = [3, 2, 0.5]\nvisible = false");
    scene(0.5, 1, &format!("{lights}[[mesh]]\nshape = \"box\"\nsize = 4\nmaterial = \"m\"\n"))
}

/// The lights' flux, twice: what the walls get, and what the points on area lights have.
fn expect_flux(what: &str, scene: &Scene, want: DVec3, noise: f64) {
    let sets = sets(scene, 4096, 16);
    let walls: Vec<_> = sets.iter().map(|set| sum(set, |light| light.extra == 1) * (PI / 0.5)).collect();
    expect_rgb(&format!("{what}, walls"), &walls, want, noise, 1e-5);
    if scene.point_lights.is_empty() {
        let points: Vec<_> =
            sets.iter().map(|set| set.emitters.iter().map(color).sum::<DVec3>() * PI).collect();
        expect_rgb(&format!("{what}, points"), &points, want, noise, 1e-5);
    }
}

const RECT: &str =
    "[[light]]\ntype = \"rect\"\ncenter = [0, 0.5, 0]\nu = [0.5, 0, 0]\nv = [0, 0.1, 0.4]\nRADIANCE\n";
const POLYGON: &str = "[[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0.75,0.25,0],[0,1,0]]\n\
                       holes = [[[0.85,0.075,0],[0.925,0.075,0],[0.925,0.375,0]]]\nRADIANCE\n";
const DISK: &str =
    "[[light]]\ntype = \"disk\"\ncenter = [0, -1, 0]\nnormal = [1, 2, 3]\nradius = 0.4\nRADIANCE\n";
const ELLIPSE: &str =
    "[[light]]\ntype = \"disk\"\ncenter = [-1, 0, 0]\nu = [0.6, 0, 0]\nv = [0, 0.3, 0]\nRADIANCE\n";
const LINE: &str = "[[light]]\ntype = \"line\"\na = [0, 0, -1]\nb = [1, 0.5, -1]\nradius = 0.03\nRADIANCE\n";
const POINT: &str = "[[light]]\ntype = \"point\"\nposition = [0.3, 0.2, 0.1]\nintensity = [3, 2, 0.5]\n";

fn closed_forms() -> [(&'static str, f64); 6] {
    [
        (RECT, 4.0 * 0.5 * 0.17_f64.sqrt() * PI),
        (POLYGON, (0.625 - 0.011_25) * PI),
        (DISK, 0.16 * PI * PI),
        (ELLIPSE, 0.18 * PI * PI),
        (LINE, 2.0 * PI * 0.03 * 1.25_f64.sqrt() * PI),
        (POINT, 4.0 * PI),
    ]
}

/// All paths of a light of one radiance carry the same: there is no noise.
#[test]
fn flux_of_one_light() {
    for (text, flux) in closed_forms() {
        expect_flux(text, &boxed(text), flux * RADIANCE, 1e-6);
    }
    for (text, flux) in closed_forms().into_iter().take(4) {
        let two_sided = format!("{text}two_sided = true\n");
        expect_flux(&two_sided, &boxed(&two_sided), 2.0 * flux * RADIANCE, 1e-6);
    }
}

#[test]
fn flux_of_all_lights_together() {
    let all: String = closed_forms().map(|(text, _)| text).concat();
    let flux = closed_forms().map(|(_, flux)| flux).iter().sum::<f64>();
    // Another colour, so that paths of lights differ.
    let red = POINT.replace("[3, 2, 0.5]", "[5, 0, 0]");
    let want = flux * RADIANCE + DVec3::X * 20.0 * PI;
    expect_flux("all", &boxed(&format!("{all}{red}")), want, 5e-3);
}

/// One bright texel among dim ones: the mean of a bilinear picture is that of its texels.
fn picture(bright: usize) -> Texture {
    let mut texels = vec![[0.1, 0.2, 0.3, 1.0]; 64];
    texels[bright] = [50.0, 20.0, 10.0, 1.0];
    Texture { name: "t".into(), width: 8, height: 8, texels: Texels::Float(texels) }
}

#[test]
fn flux_of_textured_lights() {
    let mean = (DVec3::new(0.1, 0.2, 0.3) * 63.0 + DVec3::new(50.0, 20.0, 10.0)) / 64.0;
    let square = "[[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\nRADIANCE\n";
    for (text, flux) in [(RECT, closed_forms()[0].1), (square, PI)] {
        for bright in [0, 27] {
            let mut scene = boxed(text);
            scene.textures.push(picture(bright));
            scene.area_lights[0].texture = Some(0);
            expect_flux(text, &scene, flux * RADIANCE * mean, 0.02);
        }
    }
    // A picture without light.
    let mut scene = boxed(RECT);
    scene.textures.push(Texture { texels: Texels::Float(vec![[0.0; 4]; 64]), ..picture(0) });
    scene.area_lights[0].texture = Some(0);
    assert!(sets(&scene, 256, 1)[0].bounced.is_empty());
}

/// Light of a texel that is missed where the picture is looked at to choose points: noise, and no loss.
#[test]
fn flux_of_a_spark() {
    let mut scene = boxed(RECT);
    let mut texels = vec![[0.0; 4]; 1 << 18];
    texels[243 * 512 + 331] = [1e4; 4];
    let texels = Texels::Float(texels);
    scene.textures.push(Texture { name: "s".into(), width: 512, height: 512, texels });
    scene.area_lights[0].texture = Some(0);
    let want = closed_forms()[0].1 * 3.0 * 1e4 / f64::from(1 << 18);
    let flux: Vec<_> = sets(&scene, 1 << 17, 8).iter().map(|set| sum(set, |_| true).x * (PI / 0.5)).collect();
    expect("a spark", &flux, want, 0.4, 1e-5);
}

/// The window at the wall of a sphere about a light with a range, the floors where it is close.
#[test]
fn ranges() {
    let sphere = |radius: f64, range: &str| {
        let text = format!(
            "[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [3, 2, 0.5]\n{range}\
             [[mesh]]\nshape = \"sphere\"\nradius = {radius}\nsegments = 192\nmaterial = \"m\"\n"
        );
        let sets = sets(&scene(0.5, 1, &text), 4096, 8);
        sets.iter().map(|set| sum(set, |light| light.extra == 1) * (PI / 0.5)).collect::<Vec<_>>()
    };
    let flux = 4.0 * PI * RADIANCE;
    let window = (1.0 - 1.5_f64.powi(-4)).powi(2);
    // Facets lie up to 1e-4 inside the sphere, which the window doubles; their normals differ from the sphere's.
    expect_rgb("range", &sphere(1.0, "range = 1.5\n"), flux * window, 1e-3, 4e-4);
    expect_rgb("no range", &sphere(1.0, ""), flux, 1e-3, 4e-4);
    // d² is floored at 1e-4: of a centimetre's sphere that is nothing, of half a centimetre's three quarters.
    expect_rgb("floor", &sphere(0.005, "range = 100\n"), flux * 0.25, 1e-3, 4e-4);
    assert_eq!(sphere(1.0, "range = 0.9\n")[0], DVec3::ZERO);
}
