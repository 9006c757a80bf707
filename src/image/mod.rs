//! Scene-linear pictures and their files.
//!
//! | extension | read | written |
//! | --- | --- | --- |
//! | `.exr` | RGB(A), half or float32 | float32 RGB, lossless |
//! | `.pfm` | colour or grey, either byte order | float32 RGB, little-endian |
//! | `.hdr` | Radiance RGBE | – |
//! | `.png` | 8 or 16 bit, **decoded from sRGB to scene-linear**, alpha ignored | 8-bit sRGB by [`save_png8`] |

mod atomic;
mod pfm;

pub use atomic::write_atomically;

use std::fs::File;
use std::io::{self, BufReader, BufWriter};
use std::path::Path;

use image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, ImageReader};

use crate::{Error, Result};

/// A scene-linear RGB picture, float32, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct HdrImage {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Row-major RGB.
    pub pixels: Vec<[f32; 3]>,
}

impl HdrImage {
    /// A black picture.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width as usize * height as usize] }
    }

    /// The sum of two pictures of one size.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        for (pixel, light) in self.pixels.iter_mut().zip(&other.pixels) {
            *pixel = std::array::from_fn(|channel| pixel[channel] + light[channel]);
        }
        self
    }

    /// Reads a picture by its extension; see the table of this module.
    ///
    /// # Errors
    /// [`Error::Usage`] for another extension, [`Error::Input`] for a file that is missing or damaged.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        match extension(path).as_str() {
            "pfm" => pfm::load(path),
            "exr" => load_decoded(path, ImageFormat::OpenExr),
            "hdr" => load_decoded(path, ImageFormat::Hdr),
            "png" => load_decoded(path, ImageFormat::Png).map(Self::srgb_decoded),
            _ => Err(unsupported(path, "read", ".exr, .pfm, .hdr, .png")),
        }
    }

    /// Writes a picture as float32 by its extension, `.exr` or `.pfm`; what was there stays if writing fails.
    ///
    /// Values are stored as they are, NaN and infinity too: see [`HdrImage::non_finite_count`].
    ///
    /// # Errors
    /// [`Error::Usage`] for another extension, [`Error::Write`] if the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        match extension(path).as_str() {
            "pfm" => write_atomically(path, |file| pfm::write(self, file)),
            "exr" => write_atomically(path, |file| self.write_exr(file)),
            _ => Err(unsupported(path, "write scene-linear numbers to", ".exr, .pfm")),
        }
    }

    /// Pixels of which a channel is NaN or infinite.
    #[must_use]
    pub fn non_finite_count(&self) -> usize {
        let finite = |pixel: &[f32; 3]| pixel.iter().all(|value| value.is_finite());
        self.pixels.iter().filter(|pixel| !finite(pixel)).count()
    }

    fn write_exr(&self, file: &mut BufWriter<File>) -> io::Result<()> {
        let bytes = bytemuck::cast_slice(&self.pixels);
        image::codecs::openexr::OpenExrEncoder::new(file)
            .write_image(bytes, self.width, self.height, ExtendedColorType::Rgb32F)
            .map_err(io::Error::other)
    }

    fn srgb_decoded(mut self) -> Self {
        for value in self.pixels.as_flattened_mut() {
            *value = srgb_to_linear(f64::from(*value)) as f32;
        }
        self
    }
}

/// Writes 8-bit RGB as it is (the caller has encoded it for sRGB), all or nothing.
///
/// # Errors
/// [`Error::Usage`] if the extension is not `.png` or the number of pixels is not width × height, [`Error::Write`] if
/// the file cannot be written.
pub fn save_png8(path: impl AsRef<Path>, width: u32, height: u32, pixels: &[[u8; 3]]) -> Result<()> {
    let path = path.as_ref();
    if extension(path) != "png" {
        return Err(unsupported(path, "write 8-bit colours to", ".png"));
    }
    if pixels.len() != width as usize * height as usize {
        return Err(Error::usage(
            format!("{} pixels do not make a picture of {width}x{height}", pixels.len()),
            "pass width × height pixels",
        ));
    }
    write_atomically(path, |file| {
        image::codecs::png::PngEncoder::new(file)
            .write_image(pixels.as_flattened(), width, height, ExtendedColorType::Rgb8)
            .map_err(io::Error::other)
    })
}

/// sRGB's transfer function (IEC 61966-2-1), from the encoded value in [0, 1] to scene-linear.
#[must_use]
pub fn srgb_to_linear(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Lower-case extension, empty without one.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

fn unsupported(path: &Path, verb: &str, supported: &str) -> Error {
    Error::usage(
        format!("{}: cannot {verb} a file of this type", path.display()),
        format!("use one of the extensions {supported}"),
    )
}

/// Decodes a file of a known format; [`Error::Input`] otherwise.
pub(crate) fn decode(path: &Path, format: ImageFormat) -> Result<DynamicImage> {
    let file = File::open(path)
        .map_err(|error| Error::input(path, None, error.to_string(), "check the path and its rights"))?;
    let mut reader = ImageReader::with_format(BufReader::new(file), format);
    // A float32 picture of 16,384² has 3 GiB; a decoder's default limit is a sixth of that.
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(4 << 30);
    reader.limits(limits);
    reader.decode().map_err(|error| {
        let remedy = "the file is damaged or of another type than its extension says; write it again";
        Error::input(path, None, error.to_string(), remedy)
    })
}

fn load_decoded(path: &Path, format: ImageFormat) -> Result<HdrImage> {
    let decoded = decode(path, format)?.into_rgb32f();
    let (width, height) = decoded.dimensions();
    let pixels = decoded.pixels().map(|pixel| pixel.0).collect();
    Ok(HdrImage { width, height, pixels })
}
