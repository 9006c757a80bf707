//! Image files to textures. This is the one place that decides how texels are encoded:
//!
//! | use | 8 and 16-bit files (PNG, JPEG, TGA) | HDR, EXR |
//! | --- | --- | --- |
//! | colour | [`Texels::Srgb8`] | [`Texels::Float`] |
//! | scalar | [`Texels::Linear8`] | [`Texels::Float`] |
//! | normal | [`Texels::Linear8`]; a grey picture is a height map and becomes normals | [`Texels::Float`] |
//! | mask | [`Texels::Linear8`], red = mask: the alpha channel unless it is 1 throughout, else red | likewise |
//!
//! 16-bit files are rounded to 8 bits. Texels of floating-point files that are not finite become 0, and so do
//! negative colours, with a warning.

use std::collections::HashMap;
use std::io::{self, Cursor};

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader};

use super::bump;
use super::files::Files;
use super::load::warning;
use super::parse::LARGEST;
use super::texture::{Texels, Texture};
use super::widen::Margin;

/// Longest side of a texture.
const LONGEST_SIDE: u32 = 16384;
/// Texels of all textures together take at most this many bytes.
const MOST_BYTES: u64 = 8 << 30;

/// What a texture is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Use {
    /// A colour parameter or a light's picture.
    Color,
    /// A scalar parameter.
    Scalar,
    /// A normal map, or a height map of the given strength in thousandths.
    Normal(i32),
    /// An alpha mask.
    Mask,
}

/// The textures of a scene, each file and use once.
pub(super) struct Textures<'a> {
    files: &'a Files<'a>,
    loaded: Vec<Texture>,
    index: HashMap<(String, Use), u32>,
    widened: HashMap<(u32, Margin), u32>,
    bytes: u64,
    warnings: Vec<String>,
}

/// Why a texture cannot be had, and what to do about it; who names it knows the file and the line.
pub(super) struct Fault {
    pub(super) cause: String,
    pub(super) remedy: &'static str,
}

fn fault(cause: impl Into<String>, remedy: &'static str) -> Fault {
    Fault { cause: cause.into(), remedy }
}

impl<'a> Textures<'a> {
    pub(super) fn new(files: &'a Files<'a>) -> Self {
        Self {
            files,
            loaded: Vec::new(),
            index: HashMap::new(),
            widened: HashMap::new(),
            bytes: 0,
            warnings: Vec::new(),
        }
    }

    /// The index of the texture in file `path`, loaded if it is new; `place` is where it is named.
    pub(super) fn load(&mut self, path: &str, usage: Use, place: &str) -> Result<u32, Fault> {
        let key = (path.to_owned(), usage);
        if let Some(index) = self.index.get(&key) {
            return Ok(*index);
        }
        let (texture, repaired) = self.decode(path, usage)?;
        if repaired {
            let cause = format!("texels of \"{path}\" that are not finite or negative became 0");
            self.warnings.push(warning(place, &cause, "export it again without them"));
        }
        let index = self.add(texture);
        self.index.insert(key, index);
        Ok(index)
    }

    fn add(&mut self, texture: Texture) -> u32 {
        self.loaded.push(texture);
        self.loaded.len() as u32 - 1
    }

    /// The index of the texture whose border goes on as far as coordinates of texture `index` reach, which then lie in it.
    pub(super) fn reach(&mut self, index: u32, uvs: &mut [[f32; 2]]) -> Result<u32, Fault> {
        let texture = &self.loaded[index as usize];
        let size = [texture.width, texture.height];
        let Some(margin) = Margin::around(uvs, size) else {
            return Ok(index);
        };
        let sides = margin.sides(size);
        if sides.iter().any(|side| *side > u64::from(LONGEST_SIDE)) {
            return Err(fault(
                format!("reach over {} × {} of the texture's texels, borders included", sides[0], sides[1]),
                "keep them nearer to 0…1, so that it is at most 16384 a side",
            ));
        }
        uvs.iter_mut().for_each(|uv| *uv = margin.moved(*uv, size));
        if let Some(widened) = self.widened.get(&(index, margin)) {
            return Ok(*widened);
        }
        let texture = margin.widen(texture);
        self.count(sides, matches!(texture.texels, Texels::Float(_)))?;
        let widened = self.add(texture);
        self.widened.insert((index, margin), widened);
        Ok(widened)
    }

    /// Counts what a texture takes.
    fn count(&mut self, [width, height]: [u64; 2], float: bool) -> Result<(), Fault> {
        self.bytes += width * height * if float { 16 } else { 4 };
        if self.bytes > MOST_BYTES {
            return Err(fault("with this one the textures take more than 8 GiB", "use smaller textures"));
        }
        Ok(())
    }

    /// The textures and what was repaired in them.
    pub(super) fn into_parts(self) -> (Vec<Texture>, Vec<String>) {
        (self.loaded, self.warnings)
    }

    /// The texture, and whether any of its texels had to be repaired.
    fn decode(&mut self, path: &str, usage: Use) -> Result<(Texture, bool), Fault> {
        let bytes = self.files.read(path).map_err(|error| {
            fault(format!("cannot read the texture: {error}"), "check the file's name and rights")
        })?;
        let picture = decode(path, &bytes).map_err(|error| {
            let remedy = match &error {
                ImageError::Limits(_) => "use a picture of at most 16384 texels a side",
                ImageError::Unsupported(_) => "use PNG, JPEG, TGA, HDR or EXR",
                _ => "export or download the file again; it is damaged or of another format",
            };
            fault(format!("cannot decode the texture: {error}"), remedy)
        })?;
        let (width, height) = (picture.width(), picture.height());
        if width == 0 || height == 0 {
            return Err(fault("the texture has no texels", "use a picture that has some"));
        }
        let float = matches!(picture, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
        self.count([width.into(), height.into()], float)?;
        let (texels, repaired) =
            if float { float_texels(&picture, usage) } else { (byte_texels(picture, usage), false) };
        Ok((Texture { name: path.to_owned(), width, height, texels }, repaired))
    }
}

fn decode(path: &str, bytes: &[u8]) -> Result<DynamicImage, ImageError> {
    if bytes.starts_with(&[0xff, 0xd8]) && !jpeg_is_whole(bytes) {
        // The decoder would fill the rest with grey.
        return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
    }
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    // TGA files carry no signature, so only the name tells.
    if reader.format().is_none()
        && let Ok(format) = ImageFormat::from_path(path)
    {
        reader.set_format(format);
    }
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(LONGEST_SIDE);
    limits.max_image_height = Some(LONGEST_SIDE);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder()?;
    // Not every decoder checks its limits by itself.
    limits.check_dimensions(decoder.dimensions().0, decoder.dimensions().1)?;
    decoder.set_limits(limits)?;
    DynamicImage::from_decoder(decoder)
}

/// Follows the segments of a JPEG file to its end marker (ITU T.81, B.1.1).
fn jpeg_is_whole(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(&[first, kind]) = bytes.get(at..at + 2) {
        at += match (first, kind) {
            (0xff, 0xd9) => return true,
            // A segment, whose length counts itself. What is between segments goes byte by byte: entropy-coded data, in
            // which 0 follows every 0xff, and restart markers.
            (0xff, 0xc0..=0xcf | 0xda..=0xfe) => match bytes.get(at + 2..at + 4) {
                Some(&[high, low]) => 2 + usize::from(u16::from_be_bytes([high, low])),
                _ => return false,
            },
            _ => 1,
        };
    }
    false
}

fn byte_texels(picture: DynamicImage, usage: Use) -> Texels {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let mut texels: Vec<[u8; 4]> = picture.into_rgba8().pixels().map(|pixel| pixel.0).collect();
    match usage {
        Use::Color => return Texels::Srgb8(texels),
        Use::Scalar => {}
        Use::Normal(strength) => {
            if texels.iter().all(|t| t[0] == t[1] && t[1] == t[2]) {
                texels = bump::normals(&texels, width, height, f64::from(strength) / 1000.0);
            }
        }
        Use::Mask => {
            let by_alpha = texels.iter().any(|t| t[3] != 255);
            for texel in &mut texels {
                *texel = [if by_alpha { texel[3] } else { texel[0] }; 4];
            }
        }
    }
    Texels::Linear8(texels)
}

/// The texels, and whether any had to be repaired.
fn float_texels(picture: &DynamicImage, usage: Use) -> (Texels, bool) {
    let mut texels: Vec<[f32; 4]> = picture.to_rgba32f().pixels().map(|pixel| pixel.0).collect();
    let lowest = if usage == Use::Color { 0.0 } else { -LARGEST as f32 };
    let mut repaired = false;
    for channel in texels.as_flattened_mut() {
        if !(lowest..=LARGEST as f32).contains(channel) {
            *channel = 0.0;
            repaired = true;
        }
    }
    if usage == Use::Mask && texels.iter().any(|t| t[3] != 1.0) {
        texels.iter_mut().for_each(|t| *t = [t[3]; 4]);
    }
    (Texels::Float(texels), repaired)
}
