//! The picture against the truth: side by side, or their difference.

use super::truth::Truth;
use super::views::cover;
use crate::app::false_color;
use crate::app::view::picture::Picture;
use crate::error::Result;
use crate::gpu::Image;
use crate::image::HdrImage;
use crate::passes::develop::Develop;
use crate::passes::overlay::Overlay;
use crate::scene::settings::Tonemap;
use crate::scene::{Camera, Scene};
use std::path::PathBuf;

/// Relative error that the brightest colour of a difference stands for.
pub(super) const WORST: f32 = 0.1;

/// Share of the truth's mean below which a pixel's error is relative to that, not to the pixel.
const FLOOR: f32 = 1e-3;

/// How the picture is compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Mode {
    #[default]
    Off,
    /// The truth to the right of a column.
    Split,
    /// The relative error of every pixel.
    Difference,
}

/// A comparison.
#[derive(Default)]
pub(super) struct Compare {
    pub(super) mode: Mode,
    /// Where the truth begins, as a share of the width.
    pub(super) column: f32,
    /// A file to compare with, instead of the oracle.
    pub(super) file: Option<PathBuf>,
    truth: Option<Truth>,
    /// The truth as last shown, and its version.
    image: Option<(HdrImage, u64)>,
    develop: Option<(Tonemap, f32, Develop)>,
    stale: bool,
}

/// What a comparison has the overlay draw on.
pub(super) enum Beside<'a> {
    Nothing,
    /// From this column on.
    Split(&'a Image, u32),
    /// Over all of the picture.
    Cover,
}

impl Compare {
    /// On to the next mode.
    pub(super) fn next(&mut self) {
        self.mode = match self.mode {
            Mode::Off => Mode::Split,
            Mode::Split => Mode::Difference,
            Mode::Difference => Mode::Off,
        };
        if self.column == 0.0 {
            self.column = 0.5;
        }
        self.stale = true;
    }

    /// The scene has changed: its truth is another one.
    pub(super) fn forget(&mut self) {
        self.truth = None;
        self.outdate();
    }

    /// The frame was made anew, or has another sample.
    pub(super) fn outdate(&mut self) {
        self.develop = None;
        self.stale = true;
    }

    /// The picture has another sample.
    pub(super) fn refresh(&mut self) {
        self.stale = true;
    }

    /// How far the truth is, as a sentence.
    pub(super) fn state(&self, size: [u32; 2]) -> String {
        let Some(truth) = &self.truth else {
            return "the reference begins when the view rests".into();
        };
        match (truth.done(), &self.file) {
            (Err(cause), _) => cause,
            (_, Some(file)) if truth.size() != size => {
                let [width, height] = truth.size();
                format!("{} has {width} × {height} pixels, the window has not", file.display())
            }
            (_, Some(file)) => file.display().to_string(),
            (Ok(done), None) => format!("reference, {:.0} %", 100.0 * done),
        }
    }

    /// Whether more of the truth is to be expected.
    pub(super) fn is_at_work(&self) -> bool {
        let working = |truth: &Truth| truth.done().is_ok_and(|done| done < 1.0);
        self.mode != Mode::Off && self.truth.as_ref().is_none_or(working)
    }

    /// What is shown of the comparison.
    pub(super) fn draw(
        &mut self,
        picture: &Picture,
        camera: &Camera,
        pass: &mut Overlay,
    ) -> Result<Beside<'_>> {
        let size = picture.frame.settings().size;
        if self.mode == Mode::Off {
            // Nobody waits for it.
            self.truth = None;
            return Ok(Beside::Nothing);
        }
        self.begin(&picture.scene, picture.is_complete(), camera, size);
        let Some(truth) = self.truth.as_ref().filter(|truth| truth.size() == size) else {
            return Ok(Beside::Nothing);
        };
        let newer = truth.newer(self.image.as_ref().map(|(_, version)| *version));
        let fresh = newer.is_some() || std::mem::take(&mut self.stale);
        self.image = newer.or(self.image.take());
        let Some((image, _)) = &self.image else {
            return Ok(Beside::Nothing);
        };
        if self.mode == Mode::Difference {
            if fresh {
                cover(pass, size, &difference(&picture.frame.hdr()?, image))?;
            }
            return Ok(Beside::Cover);
        }
        let render = &picture.scene.render;
        let looks = (render.tonemap, render.exposure);
        let made = self.develop.take().filter(|(tonemap, ..)| *tonemap == looks.0);
        let shown = made.as_ref().is_some_and(|(_, exposure, develop)| {
            !fresh && *exposure == looks.1 && develop.image().size() == size
        });
        let develop = match made.filter(|(.., develop)| develop.image().size() == size) {
            Some((.., develop)) => develop,
            None => picture.frame.develop_pass()?,
        };
        if !shown {
            let texels: Vec<_> = image.pixels.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
            picture.frame.develop(&develop, &texels, looks.1.exp2())?;
        }
        let column = (self.column * size[0] as f32).round() as u32;
        let (.., develop) = self.develop.insert((looks.0, looks.1, develop));
        Ok(Beside::Split(develop.image(), column))
    }

    /// Begins the truth of a view that rests, unless it is that already.
    fn begin(&mut self, scene: &Scene, rests: bool, camera: &Camera, size: [u32; 2]) {
        if let Some(file) = &self.file {
            if self.truth.is_none() {
                self.truth = Some(Truth::load(file));
                self.image = None;
            }
            return;
        }
        let same = |truth: &Truth| truth.camera.as_ref() == Some(camera) && truth.size() == size;
        if !self.truth.as_ref().is_some_and(same) {
            self.truth = rests.then(|| Truth::compute(scene, camera, size));
            self.image = None;
        }
    }
}

/// The relative error of every pixel as a heat map that ends at [`WORST`].
fn difference(picture: &HdrImage, truth: &HdrImage) -> Vec<[u8; 3]> {
    let mean = |pixel: &[f32; 3]| (pixel[0] + pixel[1] + pixel[2]) / 3.0;
    let floor = FLOOR * truth.pixels.iter().map(|pixel| f64::from(mean(pixel))).sum::<f64>() as f32
        / truth.pixels.len().max(1) as f32;
    let error = |(a, b): (&[f32; 3], &[f32; 3])| {
        let off = mean(&[0, 1, 2].map(|channel| (a[channel] - b[channel]).abs()));
        Some(off / mean(b).max(floor).max(f32::MIN_POSITIVE))
    };
    let errors: Vec<_> = picture.pixels.iter().zip(&truth.pixels).map(error).collect();
    false_color::heat(&errors, [0.0, WORST])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_relative() {
        let image = |pixels: Vec<[f32; 3]>| HdrImage { width: pixels.len() as u32, height: 1, pixels };
        let truth = image(vec![[1.0; 3], [2.0; 3], [100.0, 200.0, 300.0], [0.0; 3]]);
        let picture = image(vec![[1.0; 3], [2.2; 3], [110.0, 220.0, 330.0], [0.0; 3]]);
        let colors = difference(&picture, &truth);
        assert_eq!((colors[0], colors[3]), ([0; 3], [0; 3]));
        for off in [colors[1], colors[2]] {
            assert!(off.iter().zip([255, 250, 200]).all(|(&a, b)| a.abs_diff(b) <= 1), "{off:?}");
        }
    }
}
