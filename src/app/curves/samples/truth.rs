//! What the chapter's pictures are judged by.

use super::{Extent, Family, scene};
use crate::error::Result;
use crate::image::HdrImage;
use crate::reference::{self, Integrator, Options};

/// The oracle's picture.
pub(super) struct Truth(HdrImage);

impl Truth {
    pub(super) fn new(family: Family, extent: Extent) -> Result<Self> {
        let scene = scene(family, extent.rays, extent.size)?;
        let integrator = if family == Family::Unshadowed { Integrator::Direct } else { Integrator::Shadowed };
        let options = Options { integrator, tolerance: extent.tolerance, ..Options::of_scene(&scene) };
        Ok(Self(reference::render(&scene, &scene.cameras[0], &options)?.image))
    }

    /// Root mean square error and bias, relative to the mean.
    pub(super) fn judge(&self, image: &HdrImage) -> [f64; 2] {
        let truth: Vec<f64> = self.0.pixels.iter().flatten().map(|&value| f64::from(value)).collect();
        let whole = mean(&self.0, |value, _| value);
        let square = mean(image, |value, index| (value - truth[index]).powi(2));
        [square.sqrt() / whole, mean(image, |value, _| value) / whole - 1.0]
    }
}

/// Over all values, of a function of value and index.
fn mean(image: &HdrImage, f: impl Fn(f64, usize) -> f64) -> f64 {
    let values = image.pixels.iter().flatten().enumerate();
    values.map(|(index, &value)| f(f64::from(value), index)).sum::<f64>() / (3 * image.pixels.len()) as f64
}
