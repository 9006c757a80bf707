//! Light paths against eye paths of the oracle: what a patch of floor gets of every light and by every BSDF, shading
//! normals and luminaires included. Lights on it sum up to its radiance times its area.

use amas::reference::{Integrator, Options, render};
use amas::scene::load_embedded;
use amas::shared::VirtualLight;

use crate::{mean, sets, sum};

const FIVE: [&str; 5] = [
    "type = \"matte\"\ncolor = [0.7, 0.5, 0.3]\nsigma = 20",
    "type = \"plastic\"\ndiffuse = [0.3, 0.4, 0.5]\nroughness = 0.4",
    "type = \"metal\"\npreset = \"copper\"\nroughness = 0.5\nanisotropic = 0.5",
    "type = \"substrate\"\ndiffuse = [0.4, 0.3, 0.2]\nspecular = [0.2, 0.2, 0.2]\nroughness = 0.5",
    "type = \"principled\"\nbase_color = [0.5, 0.6, 0.3]\nmetallic = 0.3\nroughness = 0.5\nclearcoat = 0.7",
];

/// A square metre of matte floor, seen straight from above from below all else; about it walls and a coarse sphere with a
/// smooth one's normals, and lights of every kind.
fn world(material: &str, bounces: u32) -> String {
    format!(
        "[render]\nsize = [8, 8]\nshadows = true\nbackground = [0.2, 0.3, 0.4]\n\
         indirect = {{ vpls = 1024, bounces = {bounces} }}\n\
         [[camera]]\nname = \"main\"\nposition = [0, 0.02, 0]\ntarget = [0, 0, 0]\nup = [0, 0, 1]\n\
         orthographic_height = 1\nnear = 0.001\n\
         [[material]]\nname = \"p\"\ntype = \"matte\"\ncolor = [0.6, 0.6, 0.6]\ntwo_sided = false\n\
         [[material]]\nname = \"m\"\n{material}\n\
         [[mesh]]\nshape = \"plane\"\nsize = 1\nmaterial = \"p\"\n\
         [[mesh]]\nshape = \"box\"\nsize = [0.1, 2, 2]\nmaterial = \"m\"\ntranslate = [-0.7, 1.1, 0]\n\
         [[mesh]]\nshape = \"sphere\"\nradius = 0.5\nsegments = 8\nmaterial = \"m\"\ntranslate = [0.3, 1, -0.4]\n\
         [[mesh]]\nshape = \"plane\"\nsize = 2\nmaterial = \"m\"\nrotate = [0, 0, 90]\ntranslate = [1, 1.1, 0]\n\
         [[light]]\ntype = \"rect\"\ncenter = [0.3, 2.5, 0.2]\nu = [0.5, 0, 0]\nv = [0, 0, 0.4]\nradiance = [3, 4, 5]\n\
         [[light]]\ntype = \"disk\"\ncenter = [0.5, 1, 0.8]\nnormal = [-1, 0, -1]\nradius = 0.3\nradiance = [5, 3, 4]\n\
         two_sided = true\n\
         [[light]]\ntype = \"line\"\na = [-0.5, 0.3, 0.6]\nb = [0.8, 0.4, 0.7]\nradius = 0.02\nradiance = [9, 9, 5]\n\
         [[light]]\ntype = \"polygon\"\nvertices = [[0,1,-1],[1,1,-1],[1,2,-1],[0,2,-1]]\n\
         holes = [[[0.3,1.3,-1],[0.3,1.6,-1],[0.6,1.6,-1]]]\nradiance = [4, 4, 4]\nvisible = false\n\
         [[light]]\ntype = \"points\"\ngenerate = {{ count = 40, seed = 3, min = [-0.5, 0.5, -0.5], max = [0.9, 2, 0.5], \
         intensity = [0.01, 0.2], range = 2.5 }}\n\
         [[light]]\ntype = \"point\"\nposition = [0, 2, 0.7]\nintensity = [1, 1, 1]\n"
    )
}

/// The patch's radiance with so many bounces before the last surface, by sets of `count` lights and by so many rays a
/// pixel of 32 eye paths, agrees; both standard errors together are at most `noise` of it.
fn compare(material: &str, bounces: u32, count: usize, spp: u32, noise: f64) {
    // A light of depth d has d − 1 bounces before it.
    let scene = load_embedded("test.toml", &world(material, bounces + 1), &[], &[]).unwrap();
    let options =
        Options { integrator: Integrator::Path, paths: 32, bounces, spp, ..Options::of_scene(&scene) };
    let truth = render(&scene, &scene.cameras[0], &options).unwrap();
    let sets = sets(&scene, count, 12);
    for channel in 0..3 {
        let pixels: Vec<f64> = truth.image.pixels.iter().map(|pixel| f64::from(pixel[channel])).collect();
        let errors = truth.standard_error.pixels.iter().map(|pixel| f64::from(pixel[channel]));
        let of_want = errors.map(|error| error * error).sum::<f64>().sqrt() / pixels.len() as f64;
        let want = mean(&pixels).0;
        let on_patch = |light: &VirtualLight| light.position[1].abs() < 1e-3;
        let (value, error) = mean(&sets.iter().map(|set| sum(set, on_patch)[channel]).collect::<Vec<_>>());
        let both = of_want.hypot(error);
        println!("{bounces} bounces: {value:.5} ± {error:.1e}, want {want:.5} ± {of_want:.1e}, {material}");
        assert!(both < noise * want, "{material}, {bounces}: {both:e}");
        assert!((value - want).abs() < 4.0 * both, "{material}, {bounces}: {value} {want} {both:e}");
    }
}

/// Every light, and what hides it; the BSDF does not matter.
#[test]
fn light_paths_bring_direct_light() {
    compare(FIVE[0], 0, 200_000, 256, 2e-3);
}

#[test]
fn light_paths_bring_what_eye_paths_find() {
    for material in FIVE {
        for bounces in [1, 3] {
            compare(material, bounces, 30_000, 20, 0.015);
        }
    }
}
