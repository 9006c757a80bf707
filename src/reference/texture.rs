//! Bilinear texture look-ups at level 0, in double precision.

use glam::{DVec2, DVec3};

use crate::image::srgb_to_linear;
use crate::scene::{Texels, Texture};

/// What lies beyond the borders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wrap {
    /// The picture again: material textures.
    Repeat,
    /// The border's texel: light textures.
    Clamp,
}

/// The colour at `uv`, scene-linear; (0, 0) is the lower left corner and row 0 is on top. Each texel is decoded before
/// it is interpolated, as sRGB image formats of a GPU do.
pub(crate) fn sample(texture: &Texture, uv: DVec2, wrap: Wrap) -> DVec3 {
    let size = DVec2::new(f64::from(texture.width), f64::from(texture.height));
    let at = DVec2::new(uv.x, 1.0 - uv.y) * size - 0.5;
    let (corner, s) = (at.floor(), at - at.floor());
    let texel = |x: f64, y: f64| {
        let column = wrapped(corner.x + x, texture.width, wrap);
        let row = wrapped(corner.y + y, texture.height, wrap);
        fetch(texture, row * texture.width as usize + column)
    };
    let top = texel(0.0, 0.0).lerp(texel(1.0, 0.0), s.x);
    let bottom = texel(0.0, 1.0).lerp(texel(1.0, 1.0), s.x);
    top.lerp(bottom, s.y)
}

fn wrapped(index: f64, count: u32, wrap: Wrap) -> usize {
    let count = f64::from(count);
    match wrap {
        Wrap::Repeat => index.rem_euclid(count) as usize,
        Wrap::Clamp => index.clamp(0.0, count - 1.0) as usize,
    }
}

fn fetch(texture: &Texture, index: usize) -> DVec3 {
    let unit = |byte: u8| f64::from(byte) / 255.0;
    match &texture.texels {
        Texels::Srgb8(texels) => rgb(texels[index]).map(|byte| srgb_to_linear(unit(byte))).into(),
        Texels::Linear8(texels) => rgb(texels[index]).map(unit).into(),
        Texels::Float(texels) => rgb(texels[index]).map(f64::from).into(),
    }
}

fn rgb<T>([r, g, b, _]: [T; 4]) -> [T; 3] {
    [r, g, b]
}
