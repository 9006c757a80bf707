//! Full light transport of the oracle: closed forms, and its two strategies against the estimators of direct light.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod common;

use std::f64::consts::PI;

use amas::reference::{Integrator, Options, Rendered, render};
use amas::scene::{Scene, load_embedded};

/// What the oracle makes of the text of a scene file, with so many paths and bounces.
fn paths(text: &str, paths: u32, bounces: u32) -> Rendered {
    with(&scene(text), Integrator::Path, paths, bounces)
}

fn scene(text: &str) -> Scene {
    load_embedded("test.toml", text, &[], &[]).unwrap()
}

fn with(scene: &Scene, integrator: Integrator, paths: u32, bounces: u32) -> Rendered {
    let options = Options { integrator, paths, bounces, ..Options::of_scene(scene) };
    render(scene, &scene.cameras[0], &options).unwrap()
}

/// Means of value and of squared standard error over all pixels and channels.
fn mean(rendered: &Rendered) -> (f64, f64) {
    let values = || rendered.image.pixels.iter().flatten().map(|&v| f64::from(v));
    let errors = rendered.standard_error.pixels.iter().flatten().map(|&v| f64::from(v).powi(2));
    let n = values().count() as f64;
    (values().sum::<f64>() / n, errors.sum::<f64>().sqrt() / n)
}

/// The mean is `want` within four standard errors, which are at most `noise` of it, and `rounding`.
fn expect(what: &str, rendered: &Rendered, want: f64, noise: f64, rounding: f64) {
    let (value, error) = mean(rendered);
    println!("{what}: {value:.6} ± {error:.1e}, want {want:.6}");
    assert!(error <= noise * want, "{what}: {error:e}");
    assert!(
        (value - want).abs() <= 4.0 * error + rounding * want,
        "{what}: {value} ± {error:e}, want {want}"
    );
}

const CAMERA: &str = "[[camera]]\nname = \"main\"\nposition = [0.1, 0.2, 0.3]\ntarget = [1, 0.4, 0]\n\
                      vertical_fov = 80\nnear = 1e-3\n";

fn matte(albedo: f64) -> String {
    format!("[[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = [{albedo}, {albedo}, {albedo}]\n")
}

/// White things under a white sky cannot be told from it: every pixel is exactly the sky, on every path.
#[test]
fn furnace() {
    let text = format!(
        "[render]\nsize = [24, 16]\nbackground = [1, 1, 1]\n{}{}\
         [[mesh]]\nshape = \"plane\"\nsize = 8\nmaterial = \"m\"\n\
         [[mesh]]\nshape = \"box\"\nsize = 1\nmaterial = \"m\"\ntranslate = [0, 1.1, 0]\nrotate = [10, 20, 30]\n",
        CAMERA.replace("[0.1, 0.2, 0.3]", "[3, 2.5, 4]").replace("[1, 0.4, 0]", "[0, 0.8, 0]"),
        matte(1.0)
    );
    let rendered = paths(&text, 256, u32::MAX);
    // Roulette is all that makes noise; it meets some 4 of the 98,304 paths, too few for their spread to tell the error.
    expect("furnace", &rendered, 1.0, 2e-3, 2e-4);
    let direct = paths(&text, 16, 0);
    let (lit, _) = mean(&direct);
    assert!((0.5..0.999).contains(&lit), "without bounces corners are dark: {lit}");
}

/// A closed sphere of albedo ½ about a light of intensity π: ½ from the light, half of that again at each bounce.
#[test]
fn closed_sphere() {
    let text = format!(
        "[render]\nsize = [16, 12]\n{CAMERA}{}\
         [[mesh]]\nshape = \"sphere\"\nradius = 1\nsegments = 192\nmaterial = \"m\"\n\
         [[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [{PI}, {PI}, {PI}]\n",
        matte(0.5)
    );
    // 192 facets around lie up to 1e-4 inside the sphere.
    for (bounces, want) in [(0, 0.5), (1, 0.75), (2, 0.875), (u32::MAX, 1.0)] {
        expect(&format!("{bounces} bounces"), &paths(&text, 64, bounces), want, 2e-3, 4e-4);
    }
}

/// The same without direct light; of a picture of that alone nothing is left, neither of the sky behind.
#[test]
fn without_direct_light() {
    let text = format!(
        "[render]\nsize = [16, 12]\nbackground = [1, 1, 1]\n{CAMERA}{}\
         [[mesh]]\nshape = \"sphere\"\nradius = 1\nsegments = 192\nmaterial = \"m\"\n\
         [[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [{PI}, {PI}, {PI}]\n",
        matte(0.5)
    );
    let scene = scene(&text);
    let indirect = |scene: &Scene, bounces| {
        let integrator = Integrator::Path;
        let all = Options { integrator, fewest_bounces: 1, bounces, ..Options::of_scene(scene) };
        render(scene, &scene.cameras[0], &all).unwrap()
    };
    for (bounces, want) in [(1, 0.25), (2, 0.375), (u32::MAX, 0.5)] {
        expect(&format!("1 to {bounces} bounces"), &indirect(&scene, bounces), want, 4e-3, 8e-4);
    }
    let empty = Scene { meshes: Vec::new(), ..scene };
    assert_eq!(mean(&indirect(&empty, u32::MAX)), (0.0, 0.0));
}

const FIVE: [&str; 5] = [
    "type = \"matte\"\ncolor = [0.7, 0.5, 0.3]\nsigma = 20",
    "type = \"plastic\"\ndiffuse = [0.3, 0.4, 0.5]\nroughness = 0.4",
    "type = \"metal\"\npreset = \"copper\"\nroughness = 0.5\nanisotropic = 0.5",
    "type = \"substrate\"\ndiffuse = [0.4, 0.3, 0.2]\nspecular = [0.2, 0.2, 0.2]\nroughness = 0.5",
    "type = \"principled\"\nbase_color = [0.5, 0.6, 0.3]\nmetallic = 0.3\nroughness = 0.5\nclearcoat = 0.7",
];

/// A wall and a floor of a material between lights of every kind, one of them seen, one textured by its shape's hole.
fn room(material: &str) -> String {
    format!(
        "[render]\nsize = [12, 8]\nshadows = true\n[[camera]]\nname = \"main\"\nposition = [1, 2, 4]\ntarget = [0, 0.5, 0]\n\
         vertical_fov = 50\n[[material]]\nname = \"m\"\n{material}\n\
         [[mesh]]\nshape = \"plane\"\nsize = 6\nmaterial = \"m\"\n\
         [[mesh]]\nshape = \"box\"\nsize = [0.1, 2, 2]\nmaterial = \"m\"\ntranslate = [-1, 1, 0]\n\
         [[light]]\ntype = \"rect\"\ncenter = [0.3, 2.5, 0.2]\nu = [0.5, 0, 0]\nv = [0, 0, 0.4]\nradiance = [3, 4, 5]\n\
         visible = false\n\
         [[light]]\ntype = \"disk\"\ncenter = [1.5, 1, -1]\nnormal = [-1, 0, 1]\nradius = 0.4\nradiance = [5, 3, 4]\n\
         [[light]]\ntype = \"line\"\na = [-0.5, 0.3, 1]\nb = [0.8, 0.4, 1.2]\nradius = 0.02\nradiance = [20, 20, 10]\n\
         [[light]]\ntype = \"polygon\"\nvertices = [[0,1,-2],[1,1,-2],[1,2,-2],[0,2,-2]]\n\
         holes = [[[0.3,1.3,-2],[0.3,1.6,-2],[0.6,1.6,-2]]]\nradiance = [4, 4, 4]\n\
         [[light]]\ntype = \"points\"\ngenerate = {{ count = 40, seed = 3, min = [-2, 0.5, -2], max = [2, 2, 2], \
         intensity = [0.01, 0.2], range = 2.5 }}\n\
         [[light]]\ntype = \"point\"\nposition = [0, 3, 2]\nintensity = [2, 2, 2]\n"
    )
}

/// Without bounces paths estimate what the integrator of direct light does by other means: pixel by pixel within their
/// errors.
#[test]
fn without_bounces_direct_light() {
    for material in FIVE {
        let scene = scene(&room(material));
        let direct = with(&scene, Integrator::Shadowed, 1, 0);
        let path = with(&scene, Integrator::Path, 2000, 0);
        let (mut squares, mut count) = (0.0, 0.0);
        for (i, (a, b)) in path.image.pixels.iter().zip(&direct.image.pixels).enumerate() {
            let errors = [path.standard_error.pixels[i], direct.standard_error.pixels[i]];
            let [e, f] = errors.map(|pixel| f64::from(pixel[0]));
            if e > 0.0 {
                squares += f64::from(a[0] - b[0]).powi(2) / (e * e + f * f);
                count += 1.0;
            }
        }
        let (sum, error) = mean(&path);
        let (want, _) = mean(&direct);
        println!("{material}: {sum:.5} ± {error:.1e}, want {want:.5}, chi² {:.2}", squares / count);
        assert!(
            (sum - want).abs() <= 4.0 * error + 1e-3 * want,
            "{material}: {sum} ± {error:e}, want {want}"
        );
        // Mean of some 90 squares of unit normals: 1 ± .15; the tails of highlights widen it.
        assert!((0.5..1.8).contains(&(squares / count)), "{material}: {}", squares / count);
    }
}

/// A luminaire that is seen absorbs: two parallel ones between white walls let nothing be reflected twice.
#[test]
fn luminaires_end_paths() {
    let walls = |visible: bool| {
        format!(
            "[render]\nsize = [8, 6]\n{CAMERA}{}\
             [[mesh]]\nshape = \"sphere\"\nradius = 2\nsegments = 96\nmaterial = \"m\"\n\
             [[light]]\ntype = \"line\"\na = [0, -1.9, 0]\nb = [0, 1.9, 0]\nradius = 0.05\nradiance = [1, 1, 1]\n\
             visible = {visible}\n",
            matte(0.8)
        )
        .replace("position = [0.1, 0.2, 0.3]", "position = [1.5, 0.2, 0.3]")
        .replace("target = [1, 0.4, 0]", "target = [3, 0.4, 0.1]")
    };
    let [seen, unseen] = [true, false].map(|visible| mean(&paths(&walls(visible), 256, u32::MAX)));
    // Of each bounce's light the line hides about its share of the sphere's projected area, r·l/(2R²) ≈ 0.02, and a bounce
    // counts five times over: the sum loses a tenth.
    let ratio = seen.0 / unseen.0;
    assert!((0.85..0.97).contains(&ratio), "{ratio}");
}

/// The same bytes for a seed on any number of threads, others for another seed.
#[test]
fn seeds() {
    let scene = scene(&room(FIVE[1]));
    let render = |seed, threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let options = Options {
            integrator: Integrator::Path,
            paths: 8,
            seed,
            size: [6, 4],
            ..Options::of_scene(&scene)
        };
        pool.install(|| render(&scene, &scene.cameras[0], &options).unwrap())
    };
    assert_eq!(render(1, 1), render(1, 3));
    assert_ne!(render(1, 1), render(2, 1));
}
