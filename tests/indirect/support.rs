//! Scenes from texts, pictures refined round by round, and what they are judged by.

use amas::reference::{self, Integrator, Options};
use amas::refine::Rounds;
use amas::scene::load_embedded;
use amas::{Frame, FrameInputs, FrameSettings, GpuScene, HdrImage, Scene};
use std::sync::Arc;

use crate::common::gpu::CheckedGpu;

/// A scene from its text and files.
pub(crate) fn scene(text: &str, files: &[(&str, &[u8])]) -> Scene {
    load_embedded("test.toml", text, files, &[]).unwrap()
}

/// A closed room of 2 m with a red and a blue wall, seen through its front, which is only there where `more` brings it;
/// `render` are keys of [render], `floor` is the floor's material.
pub(crate) fn room(render: &str, floor: &str, more: &str) -> String {
    let wall = |material: &str, place: &str, turn: &str| {
        format!(
            "[[mesh]]\nshape = \"plane\"\nsize = 2\nmaterial = \"{material}\"\ntranslate = {place}\nrotate = {turn}\n"
        )
    };
    let matte = |name: &str, color: &str| {
        format!("[[material]]\nname = \"{name}\"\ntype = \"matte\"\ncolor = {color}\n")
    };
    [
        "[render]\ntonemap = \"none\"\nshadows = true\n",
        render,
        "\n[[camera]]\nname = \"main\"\nposition = [0, 1, 3.2]\ntarget = [0, 0.9, 0]\nvertical_fov = 42\nnear = 0.01\n",
        &matte("white", "[0.75, 0.72, 0.68]"),
        &matte("red", "[0.62, 0.1, 0.07]"),
        &matte("blue", "[0.1, 0.2, 0.55]"),
        "[[material]]\nname = \"floor\"\n",
        floor,
        "\n",
        &wall("floor", "[0, 0, 0]", "[0, 0, 0]"),
        &wall("white", "[0, 2, 0]", "[180, 0, 0]"),
        &wall("white", "[0, 1, -1]", "[90, 0, 0]"),
        &wall("red", "[-1, 1, 0]", "[0, 0, -90]"),
        &wall("blue", "[1, 1, 0]", "[0, 0, 90]"),
        more,
    ]
    .concat()
}

pub(crate) const MATTE: &str = "type = \"matte\"\ncolor = [0.7, 0.7, 0.7]";

/// A lamp under the ceiling.
pub(crate) const LAMP: &str = "[[light]]\ntype = \"rect\"\ncenter = [0, 1.98, 0]\nu = [0.25, 0, 0]\nv = [0, 0, 0.25]\n\
     radiance = [14, 12, 9]\nvisible = false\n";

/// A box and a ball on the floor.
pub(crate) const THINGS: &str = "[[mesh]]\nshape = \"box\"\nsize = 0.6\nmaterial = \"white\"\n\
     translate = [0.35, 0.3, -0.1]\nrotate = [0, 25, 0]\n\
     [[mesh]]\nshape = \"sphere\"\nradius = 0.3\nsegments = 32\nmaterial = \"white\"\ntranslate = [-0.4, 0.3, 0.2]\n";

/// A frame that is refined.
pub(crate) struct Rig {
    pub(crate) scene: Scene,
    pub(crate) gpu_scene: Arc<GpuScene>,
    pub(crate) frame: Frame,
    device: CheckedGpu,
}

impl Rig {
    /// The scene's direct light is there, and nothing gathered.
    pub(crate) fn new(scene: Scene) -> Self {
        let device = CheckedGpu::open();
        let gpu_scene = Arc::new(GpuScene::new(&device, &scene).unwrap());
        let settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
        let mut frame = Frame::new(&device, &gpu_scene, settings).unwrap();
        frame.render(&inputs(&scene)).unwrap();
        Self { scene, gpu_scene, frame, device }
    }

    /// Starts anew at another size.
    pub(crate) fn resize(&mut self, size: [u32; 2]) {
        self.frame.resize(size).unwrap();
        self.frame.render(&inputs(&self.scene)).unwrap();
    }

    /// So many rounds more: lights anew, and a frame for each stratum.
    pub(crate) fn refine(&mut self, rounds: u32) {
        let Self { scene, gpu_scene, frame, device } = self;
        let made = Rounds::new(scene, gpu_scene.origin, frame.gathers(), 0.0);
        for _ in 0..rounds {
            made.add(frame, device, &inputs(scene), &|| true).unwrap();
        }
    }

    /// Indirect light and that of point lights with shadows, all of it finite.
    pub(crate) fn gathered(&self) -> HdrImage {
        let [indirect, points] = self.frame.gathered_light().unwrap().unwrap();
        let sum = indirect.plus(&points);
        assert_eq!(sum.non_finite_count(), 0, "every value is finite");
        sum
    }

    /// The picture, all of it finite.
    pub(crate) fn picture(&self) -> HdrImage {
        let picture = self.frame.hdr().unwrap();
        assert_eq!(picture.non_finite_count(), 0, "every value is finite");
        picture
    }

    /// Estimated standard error of what is gathered, root of the mean square over pixels.
    pub(crate) fn estimate(&self) -> f64 {
        let relative = self.frame.gathered_error().unwrap().unwrap();
        relative * mean(&self.picture())
    }
}

fn inputs(scene: &Scene) -> FrameInputs<'_> {
    FrameInputs {
        camera: &scene.cameras[0],
        time: 0.0,
        samples: scene.render.samples,
        exposure: 0.0,
        split: false,
        progress: indicatif::ProgressBar::hidden(),
    }
}

/// Mean of all values.
pub(crate) fn mean(image: &HdrImage) -> f64 {
    mean_of(image, |value, _| value)
}

/// Mean over all values of a function of value and index.
fn mean_of(image: &HdrImage, f: impl Fn(f64, usize) -> f64) -> f64 {
    let values = image.pixels.iter().flatten().enumerate();
    values.map(|(index, &value)| f(f64::from(value), index)).sum::<f64>() / (3 * image.pixels.len()) as f64
}

/// The oracle's light.
pub(crate) struct Truth {
    pub(crate) image: HdrImage,
    /// Mean square of its own standard error.
    pub(crate) variance: f64,
}

impl Truth {
    /// What the frame gathers, by so many paths a pixel: all light but what shines directly from area lights, and from
    /// points where those have no shadows.
    pub(crate) fn gathered(scene: &Scene, paths: u32) -> Self {
        let options = Options { seed: 11, paths, bounces: scene.render.bounces, ..Options::of_scene(scene) };
        let all = Self::new(scene, &Options { integrator: Integrator::Path, ..options });
        let mut others = scene.clone();
        if scene.render.shadows {
            others.point_lights.clear();
        }
        let direct = Options { integrator: Integrator::Shadowed, tolerance: 2e-3, ..options };
        all.without(&Self::new(&others, &direct))
    }

    pub(crate) fn new(scene: &Scene, options: &Options) -> Self {
        let rendered = reference::render(scene, &scene.cameras[0], options).unwrap();
        let variance = mean_of(&rendered.standard_error, |error, _| error * error);
        Self { image: rendered.image, variance }
    }

    fn without(self, other: &Self) -> Self {
        let differ = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|c| a[c] - b[c]);
        let pixels = self.image.pixels.iter().zip(&other.image.pixels).map(differ).collect();
        Self { image: HdrImage { pixels, ..self.image }, variance: self.variance + other.variance }
    }

    /// Standard error of the mean of all values.
    pub(crate) fn error_of_mean(&self) -> f64 {
        // The channels of a pixel are those of the same paths.
        (self.variance / self.image.pixels.len() as f64).sqrt()
    }

    /// Root mean square error of a picture, without the truth's own.
    pub(crate) fn rmse(&self, image: &HdrImage) -> f64 {
        let truth: Vec<f64> = self.image.pixels.iter().flatten().map(|&value| f64::from(value)).collect();
        let square = mean_of(image, |value, index| (value - truth[index]).powi(2));
        (square - self.variance).max(0.0).sqrt()
    }
}

/// Rounds after which the estimate is held to the truth.
const LOOKS: [u32; 3] = [2, 4, 16];

/// 16 rounds of a scene beside the truth: their mean is within two standard errors and 1 %, and the error is what the frame
/// estimates within a factor of 1.5 after 2, 4 and 16 of them.
pub(crate) fn judge(what: &str, scene: Scene, paths: u32) -> Rig {
    let truth = Truth::gathered(&scene, paths);
    let rig = Rig::new(scene);
    judge_by(what, rig, &truth)
}

/// As [`judge`], by a truth that is known.
pub(crate) fn judge_by(what: &str, mut rig: Rig, truth: &Truth) -> Rig {
    let want = mean(&truth.image);
    let mut line = format!("{what}: truth {want:.5} ± {:.1} % a value", 100.0 * truth.variance.sqrt() / want);
    // Rounds are independent; pixels are not, since they share a round's lights.
    let (mut means, mut sum, mut ratios) = (Vec::new(), 0.0, Vec::new());
    for round in 1..=LOOKS[2] {
        rig.refine(1);
        let gathered = rig.gathered();
        let before = std::mem::replace(&mut sum, f64::from(round) * mean(&gathered));
        means.push(sum - before);
        if LOOKS.contains(&round) {
            let estimate = rig.estimate();
            let ratio = truth.rmse(&gathered) / estimate;
            ratios.push(ratio);
            line += &format!(
                "; {round} rounds: estimate {:.1} %, error over it {ratio:.2}",
                100.0 * estimate / want
            );
        }
    }
    let n = means.len() as f64;
    let mean = sum / n;
    let own = means.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
    let noise = (own + truth.error_of_mean().powi(2)).sqrt();
    line += &format!("; mean off by {:+.2} % ± {:.2}", 100.0 * (mean / want - 1.0), 100.0 * noise / want);
    println!("{line}");
    assert!((mean - want).abs() <= 2.0 * noise + 0.01 * want, "{line}");
    assert!(ratios.iter().all(|ratio| (1.0 / 1.5..1.5).contains(ratio)), "{line}");
    rig
}
