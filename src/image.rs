//! Scene-linear pictures and their files.

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
