//! Numbers as colours: heat maps of counts and ratios, hues of indices.

use crate::passes::aov::Quantity;

/// Colours of a heat map from its lower to its upper end, sRGB: the luma rises all the way, so that it reads in grey too.
const RAMP: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [48.0, 18.0, 110.0],
    [140.0, 28.0, 120.0],
    [222.0, 72.0, 62.0],
    [248.0, 160.0, 32.0],
    [255.0, 250.0, 200.0],
];

/// The picture of an output variable, and the numbers that its darkest and its brightest colour stand for, where they stand
/// for numbers.
pub(super) fn of(quantity: Quantity, values: &[[f32; 4]]) -> (Vec<[u8; 3]>, Option<[f32; 2]>) {
    let first = || values.iter().map(|&[x, .., there]| (there > 0.0).then_some(x)).collect::<Vec<_>>();
    match quantity {
        Quantity::Normal => (directions(values), None),
        Quantity::Albedo => (colors(values), None),
        Quantity::Wireframe => (lines(&first()), None),
        Quantity::Material | Quantity::Cluster => (indices(&first()), None),
        _ => {
            let first = first();
            let range = range(&first);
            (heat(&first, range), Some(range))
        }
    }
}

/// A heat map of `values` from `range[0]` to `range[1]`; where these are equal, the ramp's middle, or its lower end for zero: no
/// lights, no error. Black where there is none.
pub(super) fn heat(values: &[Option<f32>], range: [f32; 2]) -> Vec<[u8; 3]> {
    let span = f64::from(range[1] - range[0]);
    let constant = if range[0] == 0.0 { 0.0 } else { 0.5 };
    let color = |value: f32| ramp(if span > 0.0 { f64::from(value - range[0]) / span } else { constant });
    values.iter().map(|value| value.map_or([0; 3], color)).collect()
}

/// Least and largest value; zeros without any.
fn range(values: &[Option<f32>]) -> [f32; 2] {
    let values = || values.iter().copied().flatten();
    if values().next().is_none() {
        return [0.0; 2];
    }
    [values().fold(f32::INFINITY, f32::min), values().fold(f32::NEG_INFINITY, f32::max)]
}

fn ramp(x: f64) -> [u8; 3] {
    let last = RAMP.len() - 1;
    let along = x.clamp(0.0, 1.0) * last as f64;
    let below = (along as usize).min(last - 1);
    let s = along - below as f64;
    std::array::from_fn(|c| (RAMP[below][c] * (1.0 - s) + RAMP[below + 1][c] * s).round() as u8)
}

/// Colours that tell indices apart; black where there is none.
fn indices(values: &[Option<f32>]) -> Vec<[u8; 3]> {
    let color = |value: f32| {
        // Fibonacci hashing: neighbouring indices get distant hues.
        let hash = (value as i64 as u32).wrapping_add(1).wrapping_mul(0x9e37_79b9);
        let byte = |shift: u32| 56 + (hash >> shift & 255) as u8 / 5 * 3;
        [byte(24), byte(16), byte(8)]
    };
    values.iter().map(|value| value.map_or([0; 3], color)).collect()
}

/// Lines of a pixel's width along what is less than a pixel away: half on either side, fading out over the next half.
fn lines(distances: &[Option<f32>]) -> Vec<[u8; 3]> {
    const SURFACE: f32 = 0.02;
    let light = |pixels: f32| SURFACE + (1.0 - SURFACE) * (1.0 - pixels).clamp(0.0, 1.0);
    let color = |distance: &Option<f32>| {
        distance.map_or([0.0; 4], |pixels| [light(pixels), light(pixels), light(pixels), 1.0])
    };
    colors(&distances.iter().map(color).collect::<Vec<_>>())
}

/// Directions, each coordinate from −1 to 1; black where there is none.
fn directions(values: &[[f32; 4]]) -> Vec<[u8; 3]> {
    let byte = |v: f32| ((v * 0.5 + 0.5).clamp(0.0, 1.0) * 255.0).round() as u8;
    values.iter().map(|&[x, y, z, there]| if there > 0.0 { [x, y, z].map(byte) } else { [0; 3] }).collect()
}

/// Scene-linear colours, sRGB-encoded; black where there is none.
fn colors(values: &[[f32; 4]]) -> Vec<[u8; 3]> {
    let byte = |x: f32| {
        let x = x.clamp(0.0, 1.0);
        let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        (encoded * 255.0).round() as u8
    };
    values.iter().map(|&[r, g, b, there]| if there > 0.0 { [r, g, b].map(byte) } else { [0; 3] }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_brightens_from_end_to_end() {
        let map = heat(&(0..=100).map(|v| Some(v as f32)).collect::<Vec<_>>(), [0.0, 100.0]);
        let luma =
            |c: &[u8; 3]| 0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2]);
        assert!(map.windows(2).all(|pair| luma(&pair[0]) < luma(&pair[1])));
        assert_eq!((map[0], map[100]), ([0, 0, 0], [255, 250, 200]));
        assert_eq!(heat(&[None, Some(3.0)], [3.0, 3.0]), [[0; 3], [181, 50, 91]]);
        assert_eq!(heat(&[None, Some(0.0)], [0.0, 0.0]), [[0; 3]; 2]);
    }

    /// 0.5 → 188: IEC 61966-2-1.
    #[test]
    fn colours_are_encoded() {
        assert_eq!(
            colors(&[[0.0, 0.5, 2.0, 1.0], [1.0; 4], [1.0, 1.0, 1.0, 0.0]]),
            [[0, 188, 255], [255; 3], [0; 3]]
        );
    }

    #[test]
    fn neighbouring_indices_differ() {
        let map = indices(&(0..1000).map(|v| Some(v as f32)).collect::<Vec<_>>());
        assert!(map.windows(2).all(|pair| pair[0] != pair[1]));
        assert_eq!(indices(&[None]), [[0; 3]]);
        assert_eq!(range(&[None, Some(2.0), Some(-1.0)]), [-1.0, 2.0]);
    }
}
