//! The display-referred picture as 8-bit sRGB, whatever it was encoded for.

use crate::error::Result;
use crate::gpu::{Image, Use};
use crate::scene::settings::Encoding;
use glam::{DMat3, DVec3};
use half::f16;

/// Luminance of white on a display of high dynamic range, cd/m² (ITU-R BT.2408).
const WHITE: f64 = 203.0;

/// Rec. 709 to Rec. 2020 primaries (ITU-R BT.2087), by columns.
const TO_2020: DMat3 = DMat3::from_cols_array(&[
    0.627403896,
    0.069097289,
    0.016391439,
    0.329283038,
    0.919540395,
    0.088013308,
    0.043313066,
    0.011362316,
    0.895595253,
]);

/// Reads a picture of that encoding back.
pub(super) fn fetch_srgb(picture: &Image, encoding: Encoding) -> Result<Vec<[u8; 4]>> {
    let decode: fn(DVec3) -> DVec3 = match encoding {
        Encoding::Srgb => return picture.fetch(Use::TransferRead, Use::TransferRead),
        Encoding::ScRgb => |c| c * (80.0 / WHITE),
        Encoding::Hdr10 => |c| TO_2020.inverse() * DVec3::from(c.to_array().map(luminance)) / WHITE,
    };
    let texels: Vec<[f16; 4]> = picture.fetch(Use::TransferRead, Use::TransferRead)?;
    let byte = |linear: f64| (255.0 * srgb(linear.clamp(0.0, 1.0))).round() as u8;
    Ok(texels
        .iter()
        .map(|&[r, g, b, _]| {
            let [r, g, b] = decode(DVec3::new(r.to_f64(), g.to_f64(), b.to_f64())).to_array().map(byte);
            [r, g, b, 255]
        })
        .collect())
}

/// Of the perceptual quantizer's value (SMPTE ST 2084), cd/m².
fn luminance(encoded: f64) -> f64 {
    let p = encoded.clamp(0.0, 1.0).powf(1.0 / 78.84375);
    10_000.0 * ((p - 0.8359375).max(0.0) / (18.8515625 - 18.6875 * p)).powf(1.0 / 0.1593017578125)
}

/// sRGB's transfer function (IEC 61966-2-1), to the encoded value.
fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}
