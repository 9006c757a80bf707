//! Mip levels of textures, made in linear light.

use super::texture::{Texels, Texture};

/// A level of a texture: scene-linear texels, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Texels across and down.
    pub size: [usize; 2],
    /// Row by row.
    pub texels: Vec<[f32; 4]>,
}

/// The texture and its smaller levels, down to one texel. Each level is the area average of the one above: 2 × 2 texels,
/// or up to 3 weighted ones along an odd side.
#[must_use]
pub fn levels(texture: &Texture) -> Vec<Level> {
    let size = [texture.width, texture.height].map(|side| side as usize);
    let mut levels = vec![Level { size, texels: linear(&texture.texels) }];
    while let Some(above) = levels.last().filter(|level| level.size != [1, 1]) {
        let size = above.size.map(|side| (side / 2).max(1));
        let columns: Vec<_> = (0..size[0]).map(|x| footprint(x, above.size[0], size[0])).collect();
        let row = |y| {
            let rows = footprint(y, above.size[1], size[1]);
            columns.iter().map(move |columns| average(above, columns, &rows))
        };
        let texels = (0..size[1]).flat_map(row).collect();
        levels.push(Level { size, texels });
    }
    levels
}

fn linear(texels: &Texels) -> Vec<[f32; 4]> {
    let unit = |byte: u8| f32::from(byte) / 255.0;
    match texels {
        Texels::Srgb8(texels) => texels
            .iter()
            .map(|&[r, g, b, a]| [decode(unit(r)), decode(unit(g)), decode(unit(b)), unit(a)])
            .collect(),
        Texels::Linear8(texels) => texels.iter().map(|texel| texel.map(unit)).collect(),
        Texels::Float(texels) => texels.clone(),
    }
}

/// Texels of a side of `from` that texel `index` of a side of `to` covers, with weights that sum to 1.
fn footprint(index: usize, from: usize, to: usize) -> Vec<(usize, f32)> {
    let scale = from as f32 / to as f32;
    let (begin, end) = (index as f32 * scale, (index + 1) as f32 * scale);
    (begin as usize..from)
        .map(|texel| (texel, (end.min((texel + 1) as f32) - begin.max(texel as f32)) / scale))
        .take_while(|&(_, weight)| weight > 1e-5)
        .collect()
}

fn average(above: &Level, columns: &[(usize, f32)], rows: &[(usize, f32)]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for &(y, wy) in rows {
        for &(x, wx) in columns {
            let texel = above.texels[y * above.size[0] + x];
            (0..4).for_each(|c| sum[c] += wx * wy * texel[c]);
        }
    }
    sum
}

/// sRGB to linear.
pub(crate) fn decode(v: f32) -> f32 {
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(width: u32, height: u32, value: impl Fn(u32) -> f32) -> Vec<Level> {
        let texels = Texels::Float((0..width * height).map(|i| [value(i); 4]).collect());
        levels(&Texture { name: "grey".into(), width, height, texels })
    }

    #[test]
    fn a_chain_keeps_the_mean() {
        let levels = grey(8, 8, |i| i as f32 / 63.0);
        assert_eq!(levels.iter().map(|level| level.texels.len()).collect::<Vec<_>>(), [64, 16, 4, 1]);
        assert!((levels[3].texels[0][0] - 0.5).abs() < 1e-6);
        for [width, height] in [[5, 3], [1, 7], [100, 33], [641, 479]] {
            let levels = grey(width, height, |i| (i * 7919 % 1013) as f32);
            let mean = |level: &Level| {
                let sum: f64 = level.texels.iter().map(|texel| f64::from(texel[0])).sum();
                sum / level.texels.len() as f64
            };
            let base = mean(&levels[0]);
            assert!(levels.iter().all(|level| (mean(level) / base - 1.0).abs() < 1e-3));
        }
    }

    #[test]
    fn odd_and_thin_images_shrink_to_one_texel() {
        let levels = grey(5, 3, |i| (i % 5) as f32);
        assert_eq!(levels.iter().map(|level| level.texels.len()).collect::<Vec<_>>(), [15, 2, 1]);
        // Columns 0, 1 and half of 2, over two and a half; the whole keeps the mean.
        assert!((levels[1].texels[0][0] - 0.8).abs() < 1e-6);
        assert!((levels[2].texels[0][0] - 2.0).abs() < 1e-6);
    }
}
