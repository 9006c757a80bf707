//! Height maps to tangent-space normal maps.

/// Height of white above black, as a share of the picture's width, at strength 1: the relief then keeps its
/// look when the picture is stored at another resolution.
const HEIGHT: f64 = 0.02;

/// The normals of the height field in the red channel, which repeats in both directions; +y points up the
/// picture. Heights are white = [`HEIGHT`] × `strength` × width, slopes are central differences.
pub(super) fn normals(heights: &[[u8; 4]], width: usize, height: usize, strength: f64) -> Vec<[u8; 4]> {
    let scale = strength * HEIGHT * width as f64 / 255.0 / 2.0;
    let at = |x: usize, y: usize| f64::from(heights[y % height * width + x % width][0]);
    let texel = |index: usize| {
        let (x, y) = (index % width, index / width);
        let right = at(x + 1, y) - at(x + width - 1, y);
        let up = at(x, y + height - 1) - at(x, y + 1);
        encode(glam::DVec3::new(-right * scale, -up * scale, 1.0).normalize())
    };
    (0..width * height).map(texel).collect()
}

fn encode(normal: glam::DVec3) -> [u8; 4] {
    let byte = |x: f64| ((x * 0.5 + 0.5) * 255.0).round() as u8;
    [byte(normal.x), byte(normal.y), byte(normal.z), 255]
}
