//! The tables: in memory, as a file, and how they are looked up.

use std::io::{self, Write};
use std::sync::OnceLock;

use glam::DMat3;

use super::lobe::mix;
use super::{Basis, Frame, Layer, Lobe, Parameters};
use crate::error::{Error, Result};

/// What `amas fit --out` wrote, checked in.
const EMBEDDED: &[u8] = include_bytes!("tables.bin");
const MAGIC: &[u8; 8] = b"amasLTC1";
const SNORM: f32 = 32_767.0;

/// One layer's table; texel (column, row) is at row × columns + column.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerTable {
    /// The lobe.
    pub layer: Layer,
    /// The basis of the matrices.
    pub frame: Frame,
    /// Columns along r, rows along √(1 − n·wo); texel centres at the ends.
    pub size: [u32; 2],
    /// r of the first and the last column.
    pub axis: [f32; 2],
    /// Largest magnitude in `shape`: shape / scale × 32767 are whole numbers, so snorm16 loses nothing.
    pub scale: f32,
    /// (a, b, c, d) of the inverse matrix.
    pub shape: Vec<[f32; 4]>,
    /// (A0, A5, A82, TV), the first three at F = 1, or for plastic the albedos at [`super::PLASTIC_ETAS`] and TV.
    pub moments: Vec<[f32; 4]>,
}

/// A matrix and its moments, interpolated bilinearly.
#[derive(Clone, Copy, Debug)]
pub struct Lookup {
    /// The lobe.
    pub layer: Layer,
    /// M⁻¹ in the local frame (z the normal, x the tangent towards the viewer), up to a positive scale.
    pub inverse: DMat3,
    /// As [`LayerTable::moments`].
    pub moments: [f64; 4],
}

impl Lookup {
    /// The lobe's albedo.
    #[must_use]
    pub fn mass(&self) -> f64 {
        let [a, b, c, _] = self.moments;
        mix(self.layer, [a, b, c])
    }
}

impl LayerTable {
    /// A table of shapes rounded to 16 bits; the moments come later.
    pub(super) fn new(layer: Layer, shapes: &[[f64; 4]]) -> Self {
        let scale = shapes.as_flattened().iter().fold(0.0_f64, |most, value| most.max(value.abs())) as f32;
        let round = |value: f64| decode((value / f64::from(scale) * f64::from(SNORM)).round() as i16, scale);
        Self {
            scale,
            shape: shapes.iter().map(|shape| shape.map(round)).collect(),
            moments: vec![[0.0; 4]; shapes.len()],
            ..Self::empty(layer)
        }
    }

    fn empty(layer: Layer) -> Self {
        Self {
            layer,
            frame: layer.frame(),
            size: layer.size().map(|side| side as u32),
            axis: layer.axis().map(|r| r as f32),
            scale: 0.0,
            shape: Vec::new(),
            moments: Vec::new(),
        }
    }

    /// The matrix and the moments at `parameters`, clamped to the table.
    #[must_use]
    pub fn lookup(&self, parameters: Parameters) -> Lookup {
        let basis = Basis::new(self.frame, &Lobe::new(self.layer, parameters));
        let [column, row] = self.layer.texel(parameters);
        Lookup {
            layer: self.layer,
            inverse: basis.inverse(self.shape_at(parameters)),
            moments: self.bilinear(&self.moments, column, row),
        }
    }

    /// The four numbers at `parameters`, interpolated.
    #[must_use]
    pub fn shape_at(&self, parameters: Parameters) -> [f64; 4] {
        let [column, row] = self.layer.texel(parameters);
        self.bilinear(&self.shape, column, row)
    }

    fn bilinear(&self, texels: &[[f32; 4]], column: f64, row: f64) -> [f64; 4] {
        let [columns, rows] = self.size.map(|side| side as usize);
        let (left, top) = (column as usize, row as usize);
        let (right, bottom) = ((left + 1).min(columns - 1), (top + 1).min(rows - 1));
        let (u, v) = (column.fract(), row.fract());
        std::array::from_fn(|i| {
            let at = |column: usize, row: usize| f64::from(texels[row * columns + column][i]);
            let upper = at(left, top) * (1.0 - u) + at(right, top) * u;
            let lower = at(left, bottom) * (1.0 - u) + at(right, bottom) * u;
            upper * (1.0 - v) + lower * v
        })
    }

    fn write(&self, file: &mut impl Write) -> io::Result<()> {
        file.write_all(&self.scale.to_le_bytes())?;
        for value in self.shape.as_flattened() {
            file.write_all(&((value / self.scale * SNORM).round() as i16).to_le_bytes())?;
        }
        for value in self.moments.as_flattened() {
            file.write_all(&value.to_le_bytes())?;
        }
        Ok(())
    }

    fn read(layer: Layer, bytes: &mut &[u8]) -> Option<Self> {
        let count = super::grid::texels(layer);
        let scale = f32::from_le_bytes(take(bytes)?);
        let mut shape = vec![[0.0; 4]; count];
        for value in shape.as_flattened_mut() {
            *value = decode(i16::from_le_bytes(take(bytes)?), scale);
        }
        let mut moments = vec![[0.0; 4]; count];
        for value in moments.as_flattened_mut() {
            *value = f32::from_le_bytes(take(bytes)?);
        }
        Some(Self { scale, shape, moments, ..Self::empty(layer) })
    }
}

fn decode(code: i16, scale: f32) -> f32 {
    f32::from(code) / SNORM * scale
}

fn take<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (head, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(*head)
}

/// The tables of all layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Tables {
    layers: Vec<LayerTable>,
}

impl Tables {
    /// `layers` in the order of [`Layer::ALL`].
    pub(super) const fn new(layers: Vec<LayerTable>) -> Self {
        Self { layers }
    }

    /// The table of `layer`.
    #[must_use]
    pub fn layer(&self, layer: Layer) -> &LayerTable {
        // Both constructors make one table for each of `Layer::ALL`, whose order is that of the variants.
        &self.layers[layer as usize]
    }

    /// The matrix and the moments of `layer` at roughness `r` (as the layer says) and n·wo = `cos`.
    #[must_use]
    pub fn lookup(&self, layer: Layer, r: f64, cos: f64) -> Lookup {
        self.layer(layer).lookup(Parameters { r, cos })
    }

    /// The matrix and the moments of a lobe with Schlick's Fresnel of reflectance `f0`, between those of its two layers:
    /// `dielectric`, of a low reflectance, and `metal`, of F = 1 ([`schlick_share`]). Its mass is f0 A0 + (1 − f0) A5.
    ///
    /// The bound is that of a layer only where `f0` is the layer's own.
    #[must_use]
    pub fn lookup_schlick(&self, [dielectric, metal]: [Layer; 2], r: f64, cos: f64, f0: f64) -> Lookup {
        let [low, high] = [dielectric, metal].map(|layer| self.lookup(layer, r, cos));
        let [a0, a5, ..] = low.moments;
        let share = schlick_share(f0, dielectric.mixture()[0], [a0, a5]);
        Lookup { inverse: low.inverse * (1.0 - share) + high.inverse * share, ..low }
    }

    /// Writes the file that [`tables`] embeds: a magic word, then of each layer in order the scale (f32), shapes
    /// (4 × snorm16 a texel) and moments (4 × f32 a texel), then FNV-1a over all of that; little-endian.
    ///
    /// # Errors
    /// Whatever `file` says.
    pub fn write(&self, file: &mut impl Write) -> io::Result<()> {
        let mut bytes = MAGIC.to_vec();
        self.layers.iter().try_for_each(|table| table.write(&mut bytes))?;
        let sum = checksum(&bytes);
        file.write_all(&bytes)?;
        file.write_all(&sum.to_le_bytes())
    }

    /// Reads what [`Tables::write`] wrote; `None` where the bytes are anything else.
    #[must_use]
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let (body, sum) = bytes.split_last_chunk()?;
        if u64::from_le_bytes(*sum) != checksum(body) {
            return None;
        }
        let mut rest = body.strip_prefix(MAGIC)?;
        let layers = Layer::ALL.into_iter().map(|layer| LayerTable::read(layer, &mut rest));
        let layers = layers.collect::<Option<_>>()?;
        rest.is_empty().then_some(Self { layers })
    }
}

/// How much of the matrix for F = 1 there is in that for reflectance `f0`, the rest being of the matrix for reflectance
/// `low`: linear in the share of the light that the constant part of Schlick's Fresnel f0 + (1 − f0)(1 − cos)⁵ reflects,
/// given the moments A0 and A5.
#[must_use]
pub fn schlick_share(f0: f64, low: f64, [a0, a5]: [f64; 2]) -> f64 {
    let constant = |f0: f64| f0 * a0 / (f0 * a0 + (1.0 - f0) * a5);
    ((constant(f0) - constant(low)) / (1.0 - constant(low))).clamp(0.0, 1.0)
}

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

/// The tables that this program was built with, decoded once.
///
/// # Errors
/// [`Error::Input`] if the embedded file is damaged.
pub fn tables() -> Result<&'static Tables> {
    static TABLES: OnceLock<Option<Tables>> = OnceLock::new();
    TABLES.get_or_init(|| Tables::read(EMBEDDED)).as_ref().ok_or_else(|| {
        Error::input(
            "src/ltc/tables.bin",
            None,
            "the embedded tables are damaged or of another version",
            "make them anew by `amas fit --out src/ltc/tables.bin`, and build",
        )
    })
}
