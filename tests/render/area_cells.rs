//! Area lights without shadows on all five BSDFs against the oracle, cell by cell: the bounds that the product promises.

use crate::common::gpu::CheckedGpu;
use crate::support::{png, scene_with};
use amas::compare::{Figures, Mask, Options as Compare, compare};
use amas::reference::{self, Options};
use amas::{Frame, FrameInputs, FrameSettings, GpuScene, HdrImage, Scene};
use std::sync::Arc;

/// Promised of every cell with alpha ≥ 0.05.
const MEAN: f64 = 1e-2;
const P99: f64 = 5e-2;
/// Promised of textured lights with alpha ≥ 0.1.
const TEXTURED_MEAN: f64 = 3e-2;
/// Standard error of the oracle.
const TOLERANCE: f64 = 2e-3;

const ALPHAS: [f64; 5] = [0.05, 0.1, 0.25, 0.5, 0.8];

/// Large for their distance from the sphere, and partly below its horizons.
const SHAPES: [(&str, &str); 4] = [
    ("rect", "type = \"rect\"\ncenter = [0.8, 1.7, 1.6]\nu = [0.9, 0, -0.4]\nv = [0.2, -0.5, 0.45]\n"),
    (
        "n-gon",
        "type = \"polygon\"\nvertices = [[1.72, 1.65, 1.245], [1.44, 1.225, 1.8275], [0.44, 1.25, 2.245], \
         [-0.14, 1.8, 1.91], [0.69, 2.2, 1.11]]\n",
    ),
    ("disk", "type = \"disk\"\ncenter = [0.8, 1.7, 1.6]\nnormal = [-0.4, -0.7, -0.6]\nradius = 0.7\n"),
    ("line", "type = \"line\"\na = [-1.0, 1.6, 1.4]\nb = [1.6, 1.2, 1.5]\nradius = 0.05\n"),
];

/// One of the five models; `alpha` may be a pair where the model has two.
fn material(model: &str, alpha: &str) -> String {
    let number = || alpha.parse::<f64>().unwrap();
    let keys = match model {
        "matte" => format!("color = [0.5, 0.4, 0.3]\nsigma = {}", 60.0 * number()),
        "plastic" => format!("diffuse = [0.3, 0.2, 0.1]\nalpha = {alpha}"),
        "metal" => format!("preset = \"gold\"\nalpha = {alpha}"),
        "substrate" => format!("diffuse = [0.3, 0.2, 0.1]\nspecular = [0.05, 0.05, 0.05]\nalpha = {alpha}"),
        "principled" => format!(
            "base_color = [0.5, 0.3, 0.2]\nmetallic = 0.3\nroughness = {}\nclearcoat = 0.5\nclearcoat_gloss = 0.8\n\
             sheen = 0.3",
            number().sqrt()
        ),
        _ => panic!("{model}"),
    };
    format!("[[material]]\nname = \"m\"\ntype = \"{model}\"\n{keys}\n")
}

fn light(shape: &str, extra: &str) -> String {
    format!("[[light]]\n{shape}radiance = [4, 4, 4]\nvisible = false\n{extra}")
}

/// A sphere that fills the picture.
fn sphere(size: u32, material: &str, light: &str) -> String {
    format!(
        "[render]\nsize = [{size}, {size}]\n[[camera]]\nname = \"c\"\nposition = [0, 0, 6]\ntarget = [0, 0, 0]\n\
         orthographic_height = 2\n{material}[[mesh]]\nshape = \"sphere\"\nradius = 1\nsegments = [96, 48]\n\
         material = \"m\"\n{light}"
    )
}

/// Two metres of a floor, all at one angle.
fn floor(size: u32, cosine: f64, material: &str, light: &str) -> String {
    let (x, z) = (0.3, (1.0 - cosine * cosine).sqrt());
    let up = if cosine > 0.9 { "[0, 0, -1]" } else { "[0, 1, 0]" };
    format!(
        "[render]\nsize = [{size}, {size}]\n[[camera]]\nname = \"c\"\nposition = [{x}, {}, {}]\ntarget = [{x}, 0, 0]\n\
         up = {up}\northographic_height = {}\n{material}[[mesh]]\nshape = \"plane\"\nsize = 400\nmaterial = \"m\"\n{light}",
        6.0 * cosine,
        6.0 * z,
        2.0 * cosine
    )
}

/// The pixels that a sphere fills, but for its rim; all of a floor.
fn mask(scene: &Scene, rim: f64) -> Mask {
    let [width, height] = scene.render.size;
    let off = |at: u32, side: u32| (2.0 * f64::from(at) + 1.0) / f64::from(side) - 1.0;
    let keep = |i: u32| off(i % width, width).hypot(off(i / width, height)) < rim;
    Mask { width, height, keep: (0..width * height).map(keep).collect() }
}

/// A device, and the worst of the cells that it rendered.
struct Table {
    device: CheckedGpu,
    worst: [f64; 2],
    failed: Vec<String>,
}

impl Table {
    fn new() -> Self {
        Self { device: CheckedGpu::open(), worst: [0.0; 2], failed: vec![] }
    }

    fn picture(&self, scene: &Scene) -> HdrImage {
        let gpu_scene = Arc::new(GpuScene::new(&self.device, scene).unwrap());
        let settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
        let mut frame = Frame::new(&self.device, &gpu_scene, settings).unwrap();
        let progress = indicatif::ProgressBar::hidden();
        let camera = &scene.cameras[0];
        frame
            .render(&FrameInputs { camera, time: 0.0, samples: 1, exposure: 0.0, split: false, progress })
            .unwrap();
        frame.hdr().unwrap()
    }

    /// Renders and compares; no value of it is infinite or NaN.
    fn figures(&mut self, name: &str, scene: &Scene) -> Figures {
        let got = self.picture(scene);
        assert_eq!(got.non_finite_count(), 0, "{name}");
        let options = Options { tolerance: TOLERANCE, ..Options::of_scene(scene) };
        let want = reference::render(scene, &scene.cameras[0], &options).unwrap().image;
        let rim = if scene.meshes[0].vertices.len() > 8 { 0.98 } else { 2.0 };
        let mask = mask(scene, rim);
        let figures = compare(&got, &want, &Compare { mask: Some(&mask), ..Compare::default() }).unwrap();
        println!(
            "{name:<36} mean {:.4} p99 {:.4} max {:.3} bias {:+.4}",
            figures.mean_relative_error, figures.p99, figures.max, figures.mean_bias
        );
        assert!(figures.largest_b > 0.0, "{name}: the reference is not black");
        figures
    }

    fn cell(&mut self, name: &str, text: &str) {
        self.held(name, &scene_with(text, &[]), MEAN, P99);
    }

    fn held(&mut self, name: &str, scene: &Scene, mean: f64, p99: f64) {
        let figures = self.figures(name, scene);
        self.worst = [self.worst[0].max(figures.mean_relative_error), self.worst[1].max(figures.p99)];
        if figures.mean_relative_error > mean || figures.p99 > p99 {
            self.failed.push(name.into());
        }
    }

    fn finish(self) {
        println!("worst mean {:.4}, worst p99 {:.4}", self.worst[0], self.worst[1]);
        assert!(self.failed.is_empty(), "beyond the bounds: {:#?}", self.failed);
        self.device.finish();
    }
}

/// The table of a model: shapes by roughness.
fn table(model: &str) {
    let mut table = Table::new();
    for (shape, keys) in SHAPES {
        for alpha in ALPHAS {
            let text = sphere(16, &material(model, &alpha.to_string()), &light(keys, ""));
            table.cell(&format!("{model}, {shape}, alpha {alpha}"), &text);
        }
    }
    table.finish();
}

#[test]
fn matte() {
    table("matte");
}

#[test]
fn plastic() {
    table("plastic");
}

#[test]
fn metal() {
    table("metal");
}

#[test]
fn substrate() {
    table("substrate");
}

#[test]
fn principled() {
    table("principled");
}

/// Rough and smooth, from straight above down to 6°.
#[test]
fn angles_of_view() {
    angles(&[0.1, 0.3, 0.6, 1.0]);
}

#[test]
fn grazing_view() {
    angles(&[0.03]);
}

fn angles(cosines: &[f64]) {
    let rect = light(
        "type = \"rect\"\ncenter = [0, 1, -1]\nu = [0.7, 0, 0.2]\nv = [0.1, -0.4, 0.4]\n",
        "two_sided = true\n",
    );
    let mut table = Table::new();
    for model in ["matte", "plastic", "metal", "substrate", "principled"] {
        for alpha in ["0.05", "0.25", "0.8"] {
            for &cosine in cosines {
                let text = floor(8, cosine, &material(model, alpha), &rect);
                table.cell(&format!("{model}, alpha {alpha}, cosine {cosine}"), &text);
            }
        }
    }
    table.finish();
}

#[test]
fn lambertian() {
    let mut table = Table::new();
    for (shape, keys) in SHAPES {
        table.cell(&format!("Lambert, {shape}"), &sphere(16, &material("matte", "0"), &light(keys, "")));
    }
    table.finish();
}

#[test]
fn anisotropic_metal() {
    anisotropic("metal");
}

#[test]
fn anisotropic_substrate() {
    anisotropic("substrate");
}

fn anisotropic(model: &str) {
    let mut table = Table::new();
    for (shape, keys) in SHAPES {
        let text = sphere(16, &material(model, "[0.05, 0.4]"), &light(keys, ""));
        table.cell(&format!("{model}, {shape}, alpha 0.05 by 0.4"), &text);
    }
    table.finish();
}

/// A star with a hole, and its back.
#[test]
fn outlines_and_sides() {
    let mut table = Table::new();
    for model in ["matte", "plastic", "metal", "substrate", "principled"] {
        for (name, keys, extra) in [
            ("concave with a hole", STAR, ""),
            ("concave with a hole, turned, two-sided", TURNED_STAR, "two_sided = true\n"),
        ] {
            let text = sphere(16, &material(model, "0.1"), &light(keys, extra));
            table.cell(&format!("{model}, {name}, alpha 0.1"), &text);
        }
    }
    // Its front turned away, it is black.
    let dark = scene_with(&sphere(8, &material("matte", "0.1"), &light(TURNED_STAR, "")), &[]);
    assert!(table.picture(&dark).pixels.iter().all(|pixel| *pixel == [0.0; 3]));
    table.finish();
}

/// In the plane z = 2, facing the sphere.
const STAR: &str = "type = \"polygon\"\n\
    vertices = [[-0.4, 0.3, 2], [0, 1.5, 2], [0.5, 0.7, 2], [1.4, 1.2, 2], [0.9, 0.4, 2], [1.5, -0.4, 2], [0.4, 0, 2]]\n\
    holes = [[[0.3, 0.3, 2], [0.6, 0.3, 2], [0.45, 0.6, 2]]]\n";
const TURNED_STAR: &str = "type = \"polygon\"\n\
    vertices = [[0.4, 0, 2], [1.5, -0.4, 2], [0.9, 0.4, 2], [1.4, 1.2, 2], [0.5, 0.7, 2], [0, 1.5, 2], [-0.4, 0.3, 2]]\n\
    holes = [[[0.3, 0.3, 2], [0.6, 0.3, 2], [0.45, 0.6, 2]]]\n";

/// Through the floor, on it, and just above it.
#[test]
fn lights_at_the_surface() {
    let lights = [
        ("through", "type = \"rect\"\ncenter = [0, 0, -0.55]\nu = [0.6, 0, 0]\nv = [0.1, 0.5, 0.05]\n"),
        ("standing on it", "type = \"rect\"\ncenter = [0, 0.4, -0.55]\nu = [0.6, 0, 0]\nv = [0, 0.4, 0]\n"),
        ("a hand above it", "type = \"disk\"\ncenter = [0.3, 0.1, 0]\nnormal = [0, -1, 0]\nradius = 0.8\n"),
        ("disk through", "type = \"disk\"\ncenter = [0, 0.1, -0.4]\nnormal = [0.3, 0, 1]\nradius = 0.5\n"),
        ("line through", "type = \"line\"\na = [-0.4, -0.3, -0.4]\nb = [0.6, 0.6, -0.5]\nradius = 0.05\n"),
    ];
    let mut table = Table::new();
    for model in ["plastic", "metal", "substrate", "principled"] {
        for (name, keys) in lights {
            for cosine in [0.3, 0.9] {
                let text = floor(10, cosine, &material(model, "0.1"), &light(keys, ""));
                table.cell(&format!("{model}, {name}, cosine {cosine}"), &text);
            }
        }
    }
    table.finish();
}

/// A chequerboard of which a field is a quarter of what the smoothest lobe sees at once, in contrast 50.
#[test]
fn textured() {
    let texture = png([8, 8], |x, y| {
        let bright = (x / 2 + y / 2) % 2 == 0;
        if bright { [255, 250, 240, 255] } else { [40, 30, 50, 255] }
    });
    let mut table = Table::new();
    for model in ["matte", "plastic", "metal", "substrate", "principled"] {
        for (shape, keys) in &SHAPES[..3] {
            for alpha in ["0.1", "0.25", "0.5"] {
                let text = sphere(12, &material(model, alpha), &light(keys, "texture = \"t.png\"\n"));
                let scene = scene_with(&text, &[("t.png", &texture)]);
                table.held(&format!("{model}, textured {shape}, alpha {alpha}"), &scene, TEXTURED_MEAN, 1.0);
            }
        }
    }
    table.finish();
}

/// Small for its distance, and thick for its length.
#[test]
fn thick_and_far_lines() {
    let line = light("type = \"line\"\na = [-0.2, 2, 0]\nb = [0.2, 2, 0]\nradius = 0.1\n", "");
    let mut table = Table::new();
    table.cell("Lambert, thick line", &floor(4, 1.0, &material("matte", "0"), &line));
    table.finish();
}

/// Nearly a mirror: nothing is promised but that it stays finite and keeps its energy.
#[test]
fn mirrors() {
    let mut table = Table::new();
    for model in ["plastic", "metal", "substrate", "principled"] {
        for (shape, keys) in SHAPES {
            let text = sphere(12, &material(model, "0.001"), &light(keys, ""));
            let figures = table.figures(&format!("{model}, {shape}, alpha 0.001"), &scene_with(&text, &[]));
            assert!(figures.mean_bias.abs() < 0.1, "{figures:#?}");
        }
    }
    table.finish();
}
