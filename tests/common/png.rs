//! Textures made on the spot.

use image::{ImageFormat, Rgba};
use std::io::Cursor;

/// A texture as the bytes of its file.
pub(crate) fn png(size: [u32; 2], texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::RgbaImage::from_fn(size[0], size[1], |x, y| Rgba(texel(x, y)))
        .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)
        .unwrap();
    bytes
}
