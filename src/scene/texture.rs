//! Textures as loaded: one level, rows from the top.

/// A texture, repeating in both directions; sampled bilinearly with texel centres at half-integers.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// For captures and messages.
    pub name: String,
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Row 0 on top.
    pub texels: Texels,
}

/// Encoding decides how texels become numbers; this is the one place that knows.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// 8-bit colour, sRGB-encoded; alpha linear.
    Srgb8(Vec<[u8; 4]>),
    /// 8-bit data, linear.
    Linear8(Vec<[u8; 4]>),
    /// Scene-linear floating point.
    Float(Vec<[f32; 4]>),
}
