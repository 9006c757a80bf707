//! Error figures between two pictures: A, the one in question, and B, the reference.
//!
//! A *sample* is one channel of one pixel under the mask, or one channel of the mean of a block. With m the mean of B
//! over all samples:
//!
//! | figure | definition |
//! | --- | --- |
//! | relative error | e = \|a − b\| / max(\|b\|, 0.01 m) |
//! | `mean_relative_error`, `p50` … `max` | mean, percentiles (nearest rank) and greatest of e over the samples |
//! | `beyond_one_percent` | share of pixels (or blocks) of which a channel has e > 0.01, in [0, 1] |
//! | `rel_mse` | mean of (a − b)²/(b² + 0.01 m²): the usual ε = 0.01 for a picture scaled to mean 1 |
//! | `rmse` | root of the mean of (a − b)², in the pictures' unit |
//! | `mean_bias` | (mean of A − m)/m, signed |
//! | `largest_a`, `largest_b` | greatest sample |
//! | `flip` | mean ꟻLIP over the pixels under the mask, see [`flip`]; blocks do not change it |
//!
//! A pixel of which a channel of A or B is NaN or infinite is counted in `non_finite` and in no other figure. If B is
//! black (m = 0), relative figures are 0 where A is black too and infinite (`null` in JSON) where it is not.

mod convolve;
mod figures;
pub mod flip;

use std::path::Path;

use image::ImageFormat;
use serde::Serialize;

use crate::image::{decode, extension};
use crate::{Error, HdrImage, Result};

/// Which pixels count, and how they are grouped.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options<'a> {
    /// Pixels to compare; all without it.
    pub mask: Option<&'a Mask>,
    /// Side of the blocks whose means are compared, pixels; 0 and 1 compare pixels. Blocks start in the upper left
    /// corner; one that is partly outside the picture or the mask is the mean of what is inside.
    pub block: u32,
    /// Both pictures are display-referred (decoded from sRGB files): ꟻLIP takes them as they are, without the tone
    /// curve for scene-linear ones.
    pub display_referred: bool,
}

/// Error figures; the module says how each is defined.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixels compared, or blocks.
    pub compared: usize,
    /// Pixels under the mask that are NaN or infinite in A or B.
    pub non_finite: usize,
    /// Relative mean squared error.
    pub rel_mse: f64,
    /// Root mean squared error.
    pub rmse: f64,
    /// Relative difference of the means, signed.
    pub mean_bias: f64,
    /// Mean relative error.
    pub mean_relative_error: f64,
    /// Median relative error.
    pub p50: f64,
    /// 99th percentile of the relative error.
    pub p99: f64,
    /// 99.9th percentile of the relative error.
    #[serde(rename = "p99.9")]
    pub p99_9: f64,
    /// Greatest relative error.
    pub max: f64,
    /// Greatest sample of A.
    pub largest_a: f64,
    /// Greatest sample of B.
    pub largest_b: f64,
    /// Mean ꟻLIP.
    pub flip: f64,
    /// Share of pixels or blocks of which a channel is more than 1 % off.
    pub beyond_one_percent: f64,
}

/// Which pixels to compare.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Row-major, row 0 on top.
    pub keep: Vec<bool>,
}

impl Mask {
    /// Reads a PNG of which the pixels of value 255 are compared and all others are not.
    ///
    /// # Errors
    /// [`Error::Input`] if the file is missing or no PNG.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let grey = decode(path.as_ref(), ImageFormat::Png)?.into_luma8();
        let keep = grey.pixels().map(|pixel| pixel.0 == [255]).collect();
        Ok(Self { width: grey.width(), height: grey.height(), keep })
    }
}

/// Compares picture `a` with the reference `b`.
///
/// # Errors
/// [`Error::Usage`] if the sizes of the pictures or of the mask differ, or if nothing is left to compare.
pub fn compare(a: &HdrImage, b: &HdrImage, options: &Options) -> Result<Figures> {
    let size = [b.width, b.height];
    same_size("A", [a.width, a.height], size)?;
    if let Some(mask) = options.mask {
        same_size("the mask", [mask.width, mask.height], size)?;
    }
    let finite = |pixel: [f32; 3]| pixel.iter().all(|value| value.is_finite());
    let masked = |i: usize| options.mask.is_none_or(|mask| mask.keep[i]);
    let keep: Vec<_> =
        (0..b.pixels.len()).map(|i| masked(i) && finite(a.pixels[i]) && finite(b.pixels[i])).collect();
    let kept = keep.iter().filter(|&&keep| keep).count();
    if kept == 0 {
        let cause = "no pixel is left to compare: the mask is empty or every value is NaN or infinite";
        return Err(Error::usage(cause, "give a mask with pixels of value 255, or none"));
    }
    let samples = figures::samples(a, b, &keep, options.block.max(1));
    let error = flip::map(a, b, options.display_referred);
    let under_mask = error.iter().zip(&keep).filter(|(_, keep)| **keep);
    let flip = under_mask.map(|(error, _)| error).sum::<f64>() / kept as f64;
    let non_finite = (0..keep.len()).filter(|&i| masked(i)).count() - kept;
    Ok(Figures { non_finite, flip, ..figures::of_samples(size, &samples) })
}

/// Compares two files, see [`compare`]; two PNGs are taken as display-referred.
///
/// # Errors
/// Those of [`compare`], [`HdrImage::load`] and [`Mask::load`].
pub fn compare_files(a: &Path, b: &Path, mask: Option<&Path>, block: u32) -> Result<Figures> {
    let mask = mask.map(Mask::load).transpose()?;
    let display_referred = [a, b].iter().all(|path| extension(path) == "png");
    let options = Options { mask: mask.as_ref(), block, display_referred };
    let (a_image, b_image) = (HdrImage::load(a)?, HdrImage::load(b)?);
    compare(&a_image, &b_image, &options).map_err(|error| match error {
        Error::Usage { cause, remedy } => {
            Error::usage(format!("{} against {}: {cause}", a.display(), b.display()), remedy)
        }
        error => error,
    })
}

fn same_size(what: &str, [width, height]: [u32; 2], reference: [u32; 2]) -> Result<()> {
    if [width, height] == reference {
        return Ok(());
    }
    let [w, h] = reference;
    let cause = format!("{what} has {width}x{height} pixels, the reference B has {w}x{h}");
    Err(Error::usage(cause, "give pictures and a mask of one size"))
}
