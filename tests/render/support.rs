//! A device, a frame, and pictures from scene texts.

use amas::passes::aov::Quantity;
use amas::reference::{self, Options};
use amas::scene::load_embedded;
use amas::{Frame, FrameInputs, FrameSettings, GpuScene, HdrImage, Scene, Timings};
use std::sync::Arc;

use crate::common::gpu::CheckedGpu;
pub(crate) use crate::common::png::png;

/// A scene from its text.
pub(crate) fn scene(text: &str) -> Scene {
    scene_with(text, &[])
}

/// A scene from its text and files.
pub(crate) fn scene_with(text: &str, files: &[(&str, &[u8])]) -> Scene {
    load_embedded("test.toml", text, files, &[]).unwrap()
}

/// A frame on a device that checks for validation messages when dropped.
pub(crate) struct Rig {
    pub(crate) gpu_scene: Arc<GpuScene>,
    pub(crate) frame: Frame,
    pub(crate) scene: Scene,
    pub(crate) _device: CheckedGpu,
}

impl Rig {
    pub(crate) fn new(scene: Scene) -> Self {
        Self::with(scene, |_| ())
    }

    /// A frame with changed settings.
    pub(crate) fn with(scene: Scene, change: impl FnOnce(&mut FrameSettings)) -> Self {
        let device = CheckedGpu::open();
        let gpu_scene = Arc::new(GpuScene::new(&device, &scene).unwrap());
        let mut settings = FrameSettings::new(&scene.render, &scene.cameras[0]);
        change(&mut settings);
        let frame = Frame::new(&device, &gpu_scene, settings).unwrap();
        Self { gpu_scene, frame, scene, _device: device }
    }

    pub(crate) fn render(&mut self) -> HdrImage {
        self.render_at(0.0)
    }

    /// The picture at a time, in seconds, where lights move.
    pub(crate) fn render_at(&mut self, time: f64) -> HdrImage {
        self.timed(time);
        let image = self.frame.hdr().unwrap();
        assert_eq!(image.non_finite_count(), 0, "every value is finite");
        image
    }

    /// Names of the passes.
    pub(crate) fn passes(&mut self) -> Vec<&'static str> {
        self.timed(0.0).passes.iter().map(|pass| pass.name).collect()
    }

    fn timed(&mut self, time: f64) -> Timings {
        let inputs = FrameInputs {
            camera: &self.scene.cameras[0],
            time,
            samples: self.scene.render.samples,
            exposure: 0.0,
            split: false,
            progress: indicatif::ProgressBar::hidden(),
        };
        self.frame.render(&inputs).unwrap()
    }

    pub(crate) fn aov(&self, quantity: Quantity) -> Vec<[f32; 4]> {
        self.frame.aov(quantity).unwrap()
    }
}

/// The oracle's picture of the scene's first camera.
pub(crate) fn oracle(scene: &Scene) -> HdrImage {
    reference::render(scene, &scene.cameras[0], &Options::of_scene(scene)).unwrap().image
}

/// Relative errors of all values, ascending, with 1 % of the mean as the floor of the denominator.
pub(crate) fn relative_errors(a: &HdrImage, b: &HdrImage) -> Vec<f64> {
    let values = |image: &HdrImage| image.pixels.iter().flatten().map(|&v| f64::from(v)).collect::<Vec<_>>();
    let (a, b) = (values(a), values(b));
    assert_eq!(a.len(), b.len());
    let floor = 0.01 * b.iter().sum::<f64>() / b.len() as f64;
    assert!(floor > 0.0, "the reference is not black");
    let mut errors: Vec<f64> = a.iter().zip(&b).map(|(a, b)| (a - b).abs() / b.abs().max(floor)).collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// Fails unless the share `quantile` of all values is within `bound`.
pub(crate) fn assert_close(a: &HdrImage, b: &HdrImage, quantile: f64, bound: f64) {
    let errors = relative_errors(a, b);
    let at = errors[((errors.len() - 1) as f64 * quantile) as usize];
    println!("p{}: {at:.2e}, max {:.2e}", quantile * 100.0, errors[errors.len() - 1]);
    assert!(at <= bound, "relative error {at} at quantile {quantile}, {bound} allowed");
}

/// Five spheres of the five materials on a floor, seen from the front.
pub(crate) const FIVE_MATERIALS: &str = r#"
[render]
size = [96, 64]
[[camera]]
name = "main"
position = [0, 1.5, 5]
target = [0, 0.5, 0]
vertical_fov = 40
[[material]]
name = "matte"
type = "matte"
color = [0.5, 0.3, 0.2]
sigma = 30
[[material]]
name = "plastic"
type = "plastic"
diffuse = [0.1, 0.3, 0.5]
roughness = 0.4
[[material]]
name = "metal"
type = "metal"
preset = "gold"
alpha = [0.2, 0.4]
[[material]]
name = "substrate"
type = "substrate"
diffuse = [0.4, 0.1, 0.1]
specular = [0.06, 0.06, 0.06]
roughness = 0.5
anisotropic = 0.5
[[material]]
name = "principled"
type = "principled"
base_color = [0.6, 0.3, 0.1]
metallic = 0.2
roughness = 0.4
subsurface = 0.2
specular_tint = 0.3
sheen = 0.3
sheen_tint = 0.5
clearcoat = 0.6
clearcoat_gloss = 0.7
anisotropic = 0.6
[[mesh]]
shape = "plane"
size = 8
material = "matte"
[[mesh]]
shape = "sphere"
radius = 0.4
translate = [-1.5, 0.4, 0]
segments = [96, 48]
material = "matte"
[[mesh]]
shape = "sphere"
radius = 0.4
translate = [-0.75, 0.4, 0]
segments = [96, 48]
material = "plastic"
[[mesh]]
shape = "sphere"
radius = 0.4
translate = [0, 0.4, 0]
segments = [96, 48]
material = "metal"
[[mesh]]
shape = "sphere"
radius = 0.4
translate = [0.75, 0.4, 0]
segments = [96, 48]
material = "substrate"
[[mesh]]
shape = "sphere"
radius = 0.4
translate = [1.5, 0.4, 0]
segments = [96, 48]
material = "principled"
"#;

/// Lights of a range in a box around [`FIVE_MATERIALS`].
pub(crate) fn ranged_lights(count: usize, range: f32) -> String {
    format!(
        "[[light]]\ntype = \"points\"\ngenerate = {{ count = {count}, seed = 5, min = [-4, 0.02, -4], max = [4, 3, 4], \
         intensity = [0.1, 1.0], range = {range} }}\n"
    )
}

/// Lights without a range around [`FIVE_MATERIALS`].
pub(crate) fn unranged_lights(count: usize) -> String {
    format!(
        "[[light]]\ntype = \"points\"\ngenerate = {{ count = {count}, seed = 9, min = [-4, 0.5, -4], max = [4, 3, 4], \
         intensity = [0.1, 1.0] }}\n"
    )
}
