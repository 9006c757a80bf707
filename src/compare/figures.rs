//! Samples and the figures over them.

use super::Figures;
use crate::HdrImage;

/// Colours of A and B at a pixel or block.
pub(super) type Sample = [[f64; 3]; 2];

/// Share of the reference's mean below which errors are taken as absolute.
const FLOOR: f64 = 0.01;
/// ε of the relMSE for a mean of 1.
const EPSILON: f64 = 0.01;

/// Means of the kept pixels of each block; blocks without one are left out.
pub(super) fn samples(a: &HdrImage, b: &HdrImage, keep: &[bool], block: u32) -> Vec<Sample> {
    let (width, block) = (b.width as usize, block as usize);
    let columns = width.div_ceil(block);
    let rows = (b.height as usize).div_ceil(block);
    let mut sums = vec![([[0.0; 3]; 2], 0_u32); columns * rows];
    for index in (0..keep.len()).filter(|&index| keep[index]) {
        let (x, y) = (index % width, index / width);
        let (sum, count) = &mut sums[y / block * columns + x / block];
        for (sum, pixel) in sum.iter_mut().zip([a.pixels[index], b.pixels[index]]) {
            sum.iter_mut().zip(pixel).for_each(|(sum, value)| *sum += f64::from(value));
        }
        *count += 1;
    }
    let mean =
        |(sum, count): ([[f64; 3]; 2], u32)| sum.map(|color| color.map(|value| value / f64::from(count)));
    sums.into_iter().filter(|(_, count)| *count > 0).map(mean).collect()
}

/// All figures but FLIP and the count of non-finite pixels, which are 0.
pub(super) fn of_samples([width, height]: [u32; 2], samples: &[Sample]) -> Figures {
    let n = (3 * samples.len()) as f64;
    let pairs = || samples.iter().flat_map(|[a, b]| a.iter().copied().zip(b.iter().copied()));
    let mean = pairs().map(|(_, b)| b).sum::<f64>() / n;
    let difference = pairs().map(|(a, b)| a - b).sum::<f64>() / n;
    let error = |a: f64, b: f64| ratio((a - b).abs(), b.abs().max(FLOOR * mean));
    let mut errors: Vec<_> = pairs().map(|(a, b)| error(a, b)).collect();
    errors.sort_unstable_by(f64::total_cmp);
    let off = |[a, b]: &&Sample| a.iter().zip(b).any(|(&a, &b)| error(a, b) > 0.01);
    let relative_square = |(a, b): (f64, f64)| ratio((a - b).powi(2), b * b + EPSILON * mean * mean);
    let largest =
        |which: usize| samples.iter().flat_map(|sample| sample[which]).fold(f64::NEG_INFINITY, f64::max);
    Figures {
        width,
        height,
        compared: samples.len(),
        non_finite: 0,
        rel_mse: pairs().map(relative_square).sum::<f64>() / n,
        rmse: (pairs().map(|(a, b)| (a - b).powi(2)).sum::<f64>() / n).sqrt(),
        mean_bias: ratio(difference, mean),
        mean_relative_error: errors.iter().sum::<f64>() / n,
        p50: percentile(&errors, 0.5),
        p99: percentile(&errors, 0.99),
        p99_9: percentile(&errors, 0.999),
        max: percentile(&errors, 1.0),
        largest_a: largest(0),
        largest_b: largest(1),
        flip: 0.0,
        beyond_one_percent: samples.iter().filter(off).count() as f64 / samples.len() as f64,
    }
}

/// 0/0 is 0: equal blacks do not differ.
fn ratio(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale }
}

/// The least sorted value that at least the share `p` of all does not exceed.
fn percentile(sorted: &[f64], p: f64) -> f64 {
    let rank = (p * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
}
