//! Gathered light of the frame: indirect light, and that of point lights whose shadows are wanted.

use super::timing::Stopwatch;
use super::{Frame, FrameInputs, FrameSettings, Timings};
use crate::error::Result;
use crate::gpu::{Device, Use};
use crate::gpu_scene::GpuScene;
use crate::image::HdrImage;
use crate::passes::PassInputs;
use crate::passes::forward::Sample;
use crate::passes::gather::{Gather, Gathered, GatheredLights};
use crate::shared::{GATHER_FRAMES, GATHER_SIDE, GATHER_SUBSETS};
use crate::targets::Targets;
use rayon::prelude::*;
use std::sync::Arc;

const SUBSETS: usize = GATHER_SUBSETS as usize;
/// Vertices of paths that one submission to a GPU has at most.
const PATHS_A_SUBMISSION: u32 = 1 << 22;
/// Pixels that one task looks at.
const PART: usize = 4096;

/// Sums of gathered light, as fetched.
struct Sums {
    texels: Vec<[f32; 4]>,
    pixels: usize,
}

impl Sums {
    fn of(&self, layer: usize, pixel: usize) -> [f32; 4] {
        self.texels[layer * self.pixels + pixel]
    }
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
        [0..SUBSETS, SUBSETS..2 * SUBSETS].map(|layers| {
            let pixel = |index: usize| {
                let sum =
                    |channel: usize| layers.clone().map(|layer| sums.of(layer, index)[channel]).sum::<f32>();
                [0, 1, 2].map(|channel| sum(channel) * per_frame)
            };
            self.image((0..sums.pixels).into_par_iter().map(pixel).collect())
        })
    }

    fn sums(&self) -> Result<Option<Sums>> {
        let Some(gather) = self.gather.as_ref().filter(|_| self.gathered > 0) else { return Ok(None) };
        let texels: Vec<[f32; 4]> = gather.sums().fetch(Use::FragmentRead, Use::FragmentRead)?;
        Ok(Some(Sums { pixels: texels.len() / (2 * SUBSETS), texels }))
    }

    /// Estimated relative error of the picture that comes of gathered light: the root of the mean square over pixels of its
    /// standard error, over the mean of the picture; 0 of a black picture. `None` before two rounds are complete.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn gathered_error(&self) -> Result<Option<f64>> {
        let rounds = self.gathered / GATHER_FRAMES;
        let Some(sums) = self.sums()?.filter(|_| rounds >= 2) else { return Ok(None) };
        // Frames of each subset, and the subsets that have any.
        let subsets = SUBSETS.min(rounds as usize);
        let frames = |subset: usize| {
            let whole = u64::from(self.gathered) / u64::from(GATHER_FRAMES) / SUBSETS as u64;
            let rest = u64::from(self.gathered) - whole * u64::from(GATHER_FRAMES) * SUBSETS as u64;
            let own =
                rest.saturating_sub(subset as u64 * u64::from(GATHER_FRAMES)).min(u64::from(GATHER_FRAMES));
            (whole * u64::from(GATHER_FRAMES) + own) as f64
        };
        let counts: Vec<f64> = (0..subsets).map(frames).collect();
        let all: f64 = counts.iter().sum();
        let variance = |pixel: usize, channel: usize| {
            let layer = |layer: usize| f64::from(sums.of(layer, pixel)[channel]);
            let sum = |subset: usize| layer(subset) + layer(SUBSETS + subset);
            let mean = (0..subsets).map(sum).sum::<f64>() / all;
            let spread = |subset: usize| counts[subset] * (sum(subset) / counts[subset] - mean).powi(2);
            (0..subsets).map(spread).sum::<f64>() / ((subsets - 1) as f64 * all)
        };
        // Parts of a fixed size, so that the sum is the same on any number of threads.
        let part = |first: usize| -> f64 {
            let pixels = first..sums.pixels.min(first + PART);
            pixels.map(|pixel| (0..3).map(|channel| variance(pixel, channel)).sum::<f64>()).sum()
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
    let pass = wanted.anything().then(|| Gather::new(inputs, targets, wanted)).transpose()?;
    if let Some(gather) = &pass {
        blacken(inputs.device, gather)?;
    }
    Ok(pass)
}

/// Makes the sums black: the present subpass reads them before anything is gathered.
pub(super) fn blacken(device: &Arc<Device>, gather: &Gather) -> Result<()> {
    device.run("gathered light", |cmd| {
        cmd.transition(gather.sums(), Use::Nothing, Use::TransferWrite);
        cmd.clear(gather.sums());
        cmd.transition(gather.sums(), Use::TransferWrite, Use::FragmentRead);
        Ok(())
    })
}
