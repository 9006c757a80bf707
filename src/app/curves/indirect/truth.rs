//! What pictures are judged by: paths in double precision; and the same paths as a competitor.

use super::figures::{Family, Sample};
use crate::error::Result;
use crate::image::HdrImage;
use crate::reference::{Integrator, Options, Rendered, render};
use crate::scene::Scene;
use cpu_time::ProcessTime;
use std::time::Instant;

/// Seed of the truth; competitors have others.
const SEED: u64 = 1 << 32;

/// Light that comes by way of other surfaces.
pub(super) struct Truth {
    image: HdrImage,
    /// Mean square of its standard error.
    variance: f64,
    /// Mean of all values of the whole picture.
    whole: f64,
}

impl Truth {
    /// By so many paths a pixel, of a picture whose direct light has the mean `direct`.
    pub(super) fn new(scene: &Scene, paths: u32, direct: f64) -> Result<Self> {
        let Rendered { image, standard_error } = paths_from_the_eye(scene, paths, SEED)?;
        let variance = mean(&standard_error, |value, _| value * value);
        let whole = direct + mean(&image, |value, _| value);
        Ok(Self { image, variance, whole })
    }

    /// Root mean square of its own standard error, relative to the mean of the picture.
    pub(super) fn relative_error(&self) -> f64 {
        self.variance.sqrt() / self.whole
    }

    /// Mean square error over the square of the picture's mean, and bias relative to the light's own mean.
    pub(super) fn judge(&self, image: &HdrImage) -> [f64; 2] {
        let values: Vec<f64> = self.image.pixels.iter().flatten().map(|&value| f64::from(value)).collect();
        let square = mean(image, |value, index| (value - values[index]).powi(2)) - self.variance;
        let want = mean(&self.image, |value, _| value);
        [square / self.whole.powi(2), mean(image, |value, _| value) / want - 1.0]
    }

    /// Pictures of 1, 2, 4 … paths a pixel.
    pub(super) fn paths(&self, scene: &Scene, repetition: u32, most: u32) -> Result<Vec<Sample>> {
        let counts = (0..=most.ilog2()).map(|log2| 1 << log2);
        let sample = |count| {
            let clocks = (Instant::now(), ProcessTime::now());
            let seed = u64::from(repetition) << 16 | u64::from(count);
            let image = paths_from_the_eye(scene, count, seed)?.image;
            let (wall_s, cpu_s) = (clocks.0.elapsed().as_secs_f64(), clocks.1.elapsed().as_secs_f64());
            let [square, bias] = self.judge(&image);
            Ok(Sample {
                family: Family::Paths,
                count,
                rounds: 1,
                cpu_s,
                wall_s,
                square,
                bias,
                estimate: None,
            })
        };
        counts.map(sample).collect()
    }
}

fn paths_from_the_eye(scene: &Scene, paths: u32, seed: u64) -> Result<Rendered> {
    let options = Options {
        integrator: Integrator::Path,
        paths,
        seed,
        fewest_bounces: 1,
        bounces: scene.render.bounces,
        ..Options::of_scene(scene)
    };
    render(scene, &scene.cameras[0], &options)
}

/// Mean over all values of a function of value and index.
pub(super) fn mean(image: &HdrImage, f: impl Fn(f64, usize) -> f64) -> f64 {
    let values = image.pixels.iter().flatten().enumerate();
    values.map(|(index, &value)| f(f64::from(value), index)).sum::<f64>() / (3 * image.pixels.len()) as f64
}
