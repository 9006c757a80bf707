//! Gathered light of the frame: indirect light, and that of point lights whose shadows are wanted.

use super::timing::Stopwatch;
use super::{Frame, FrameInputs, FrameSettings, Timings};
use crate::error::Result;
use crate::gpu::Use;
use crate::gpu_scene::GpuScene;
use crate::image::HdrImage;
use crate::passes::PassInputs;
use crate::passes::forward::Sample;
use crate::passes::gather::{Gather, Gathered, GatheredLights};
use crate::shared::{GATHER_FRAMES, GATHER_SIDE, GATHER_SUBSETS};
use crate::targets::Targets;
use rayon::prelude::*;

const SUBSETS: usize = GATHER_SUBSETS as usize;
/// Vertices of paths that one submission to a GPU has at most.
const PATHS_A_SUBMISSION: u32 = 1 << 22;
/// Pixels that one task looks at.
const PART: usize = 4096;

/// Sums of gathered light, as fetched: a layer for each subset of indirect light, then of point lights, of what there is.
struct Sums {
    texels: Vec<[f32; 4]>,
    pixels: usize,
}

impl Sums {
    /// Of a pixel's channel: sums of a subset, of every kind of light that there is.
    fn kinds(&self, subset: usize, pixel: usize, channel: usize) -> impl Iterator<Item = f32> {
        let layers = (subset..self.texels.len() / self.pixels).step_by(SUBSETS);
        layers.map(move |layer| self.texels[layer * self.pixels + pixel][channel])
    }
}

impl Sums {
    /// Variance of the mean of a pixel's channel, by how subsets of so many frames differ.
    fn variance(&self, pixel: usize, channel: usize, counts: &[f64]) -> f64 {
        let sum = |subset| self.kinds(subset, pixel, channel).map(f64::from).sum::<f64>();
        let all: f64 = counts.iter().sum();
        let mean = (0..counts.len()).map(sum).sum::<f64>() / all;
        let spread = |(subset, &count): (usize, &f64)| count * (sum(subset) / count - mean).powi(2);
        counts.iter().enumerate().map(spread).sum::<f64>() / ((counts.len() - 1) as f64 * all)
    }
}

/// Frames of each subset that has any: whole rounds take turns at them, and a frame of a round counts.
fn frames_of_subsets(frames: u32) -> Vec<f64> {
    let mut counts = [0.0; SUBSETS];
    (0..frames).for_each(|frame| counts[(frame / GATHER_FRAMES % GATHER_SUBSETS) as usize] += 1.0);
    counts.into_iter().filter(|&count| count > 0.0).collect()
}

impl Frame {
    /// What is gathered, frame by frame, once the picture has its samples.
    #[must_use]
    pub fn gathers(&self) -> Gathered {
        self.work.gathered
    }

    /// Gathers from these lights from now on.
    pub fn set_gathered_lights(&mut self, lights: GatheredLights) {
        if let Some(gather) = &self.gather {
            gather.set_lights(&lights);
        }
        self.gathered_lights = Some(lights);
    }

    pub(super) fn forget_gathered(&mut self) {
        self.gathered = 0;
        self.gathered_rows = 0;
    }

    /// Frames of gathered light that the picture has.
    #[must_use]
    pub fn gathered(&self) -> u32 {
        self.gathered
    }

    /// Adds a frame of gathered light to the picture, from the lights set last; every `GATHER_FRAMES` frames make a round,
    /// for which other lights are due. Nothing where there is nothing to gather.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn gather(&mut self, inputs: &FrameInputs<'_>) -> Result<Timings> {
        let rows = self.rows_a_submission();
        let mut timings = self.gather_rows(inputs, rows)?;
        while self.gathered_rows > 0 {
            timings.add(&self.gather_rows(inputs, rows)?);
        }
        Ok(timings)
    }

    /// Rows of which the paths take far less than a GPU's watchdog allows; a CPU has none.
    fn rows_a_submission(&self) -> u32 {
        if self.device.is_cpu() {
            return u32::MAX;
        }
        let paths = self.settings.size[0] * GATHER_SIDE * (self.settings.bounces + 1);
        (PATHS_A_SUBMISSION / paths).max(1)
    }

    /// Rows of blocks of pixels in a frame of gathered light; 0 where nothing is gathered.
    #[must_use]
    pub fn rows_to_gather(&self) -> u32 {
        self.gather.as_ref().map_or(0, Gather::rows)
    }

    /// Of the next frame of gathered light: rows of blocks that are done.
    #[must_use]
    pub fn rows_gathered(&self) -> u32 {
        self.gathered_rows
    }

    /// Whether samples from now on have the point lights whose light is gathered, but without shadows: for a picture that is
    /// to be seen at once. Only where [`FrameSettings::preview`] is set.
    pub fn preview(&mut self, preview: bool) {
        self.previews = preview;
    }

    /// Whether samples have point lights.
    pub(super) fn has_points(&self) -> bool {
        self.previews || !self.work.gathered.points
    }

    /// As [`Frame::gather`], the next so many rows of the frame; with the last of them the frame counts.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn gather_rows(&mut self, inputs: &FrameInputs<'_>, rows: u32) -> Result<Timings> {
        let mut watch = Stopwatch::start(&["gather"]);
        let index = self.gathered;
        let first = self.gathered_rows;
        if first == 0 {
            self.update_constants(inputs, index)?;
        }
        let (Some(gather), Some(lights)) = (&self.gather, &self.gathered_lights) else {
            return Ok(watch.stop());
        };
        let end = gather.rows().min(first.saturating_add(rows));
        let complete = end == gather.rows();
        self.gathered_rows = if complete { 0 } else { end };
        self.gathered += u32::from(complete);
        let sample =
            Sample { first: false, shaded: false, points: false, scales: self.scales(inputs, self.samples) };
        let before = watch.cpu();
        self.device.run("gather", |cmd| {
            // Without jitter every frame sees the same surfaces.
            if first == 0 && (index == 0 || inputs.samples > 1) {
                self.prepass.record(cmd, &self.view());
                gather.begin(cmd, &self.view(), index);
            }
            gather.record(cmd, &self.view(), lights, index, first..end);
            if complete {
                if self.work.resolve {
                    cmd.transition(&self.targets.hdr, Use::TransferRead, Use::ComputeWrite);
                }
                cmd.reset_timestamps(&self.timestamps);
                self.forward.record(cmd, &self.view(), sample, (&self.timestamps, 0));
            }
            Ok(())
        })?;
        watch.add_cpu(1, before);
        Ok(watch.stop())
    }

    /// Factors on the sums of samples, of which there are so many, and of gathered light.
    pub(super) fn scales(&self, inputs: &FrameInputs<'_>, samples: u32) -> [f32; 2] {
        let exposure = inputs.exposure.exp2();
        let mean = |count: u32| if count > 0 { exposure / count as f32 } else { 0.0 };
        [mean(samples), mean(self.gathered)]
    }

    /// Mean of gathered light: first that which comes by way of other surfaces, then that of point lights; `None` where
    /// there is none yet.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn gathered_light(&self) -> Result<Option<[HdrImage; 2]>> {
        Ok(self.sums()?.map(|sums| self.mean_light(&sums)))
    }

    fn mean_light(&self, sums: &Sums) -> [HdrImage; 2] {
        let per_frame = 1.0 / self.gathered as f32;
        let Gathered { indirect, points, .. } = self.work.gathered;
        [(indirect, 0), (points, usize::from(indirect))].map(|(there, kind)| {
            let sum = |pixel, channel| {
                let of_subset = |subset| sums.kinds(subset, pixel, channel).nth(kind).filter(|_| there);
                (0..SUBSETS).filter_map(of_subset).sum::<f32>() * per_frame
            };
            let pixel = |pixel: usize| [0, 1, 2].map(|channel| sum(pixel, channel));
            self.image((0..sums.pixels).into_par_iter().map(pixel).collect())
        })
    }

    fn sums(&self) -> Result<Option<Sums>> {
        let Some(gather) = self.gather.as_ref().filter(|_| self.gathered > 0) else { return Ok(None) };
        let texels: Vec<[f32; 4]> = gather.sums().fetch(Use::FragmentRead, Use::FragmentRead)?;
        let [width, height] = self.settings.size;
        Ok(Some(Sums { texels, pixels: (width * height) as usize }))
    }

    /// Estimated relative error of the picture that comes of gathered light: the root of the mean square over pixels of its
    /// standard error, over the mean of the picture; 0 of a black picture. `None` before two rounds are complete.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn gathered_error(&self) -> Result<Option<f64>> {
        let counts = frames_of_subsets(self.gathered);
        let Some(sums) = self.sums()?.filter(|_| self.gathered >= 2 * GATHER_FRAMES) else { return Ok(None) };
        // Parts of a fixed size, so that the sum is the same on any number of threads.
        let part = |first: usize| -> f64 {
            let pixels = first..sums.pixels.min(first + PART);
            pixels
                .map(|pixel| (0..3).map(|channel| sums.variance(pixel, channel, &counts)).sum::<f64>())
                .sum()
        };
        let firsts: Vec<usize> = (0..sums.pixels).step_by(PART).collect();
        let variance: f64 = firsts.into_par_iter().map(part).collect::<Vec<_>>().iter().sum();
        let picture = self.picture_of(Some(&self.mean_light(&sums)))?;
        let total: f64 = picture.pixels.iter().flatten().map(|&value| f64::from(value)).sum();
        let values = (3 * picture.pixels.len()) as f64;
        let relative = (variance / values).sqrt() / (total / values);
        Ok(Some(if variance == 0.0 { 0.0 } else { relative }))
    }
}

/// What a scene's frames gather.
pub(super) fn wanted(scene: &GpuScene, settings: &FrameSettings) -> Gathered {
    let drawn = !scene.draws.is_empty() && !settings.brute_force;
    Gathered {
        indirect: drawn && settings.indirect,
        points: drawn && settings.shadows && !scene.lights.lights.is_empty(),
        shadows: settings.shadows,
        lambert: scene.lambertian && settings.background == [0.0; 3],
        bounces: settings.bounces,
    }
}

pub(super) fn pass(inputs: &PassInputs<'_>, targets: &Targets, wanted: Gathered) -> Result<Option<Gather>> {
    wanted.anything().then(|| Gather::new(inputs, targets, wanted)).transpose()
}
