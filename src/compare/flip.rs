//! ꟻLIP: how different two pictures look when they alternate on a screen, in [0, 1] a pixel.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, *ꟻLIP: A Difference Evaluator for
//! Alternating Images* (LDR-ꟻLIP, with the erratum of the feature normalisation), at its default viewing conditions:
//! 0.7 m from a 0.7 m wide screen of 3840 pixels, 67 pixels a degree.
//!
//! Scene-linear pictures are displayed first: both are scaled by the same factor that brings the mean luminance of the
//! reference to 0.18, then each channel by Reinhard's x/(1 + x) (2002). The figure is therefore independent of the
//! exposure. It is LDR-ꟻLIP of that display, **not** HDR-ꟻLIP, which takes the worst of many exposures.

use rayon::prelude::*;

use super::convolve::{Kernel, Size, convolve};
use crate::HdrImage;

/// Pixels a degree of the visual field.
const PIXELS_PER_DEGREE: f64 = 3840.0 / 0.7 * 0.7 * std::f64::consts::PI / 180.0;
/// Exponent of the colour difference.
const QC: f64 = 0.7;
/// Exponent of the feature difference.
const QF: f64 = 0.5;
/// Colour differences up to the share PC of the greatest are mapped to [0, PT].
const PC: f64 = 0.4;
const PT: f64 = 0.95;
/// Width of the feature detector, degrees.
const FEATURE_WIDTH: f64 = 0.082;

/// (a, b) of the two Gaussians a √(π/b) exp(−π²x²/b), x in degrees, of the achromatic, red–green and blue–yellow
/// contrast sensitivity.
const SENSITIVITY: [[(f64, f64); 2]; 3] =
    [[(1.0, 0.0047), (0.0, 1e-5)], [(1.0, 0.0053), (0.0, 1e-5)], [(34.1, 0.04), (13.5, 0.025)]];

/// Linear sRGB to XYZ (IEC 61966-2-1).
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [0.412_386_56, 0.357_591_49, 0.180_450_49],
    [0.212_636_82, 0.715_182_98, 0.072_180_20],
    [0.019_330_62, 0.119_197_16, 0.950_372_59],
];
/// Its inverse.
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_28, -1.537_398_97, -0.498_615_88],
    [-0.969_224_25, 1.875_929_98, 0.041_554_23],
    [0.055_639_42, -0.204_011_21, 1.057_148_98],
];
/// XYZ of white, the sums of the rows above.
const WHITE: [f64; 3] = [0.950_428_54, 1.0, 1.088_900_37];

type Color = [f64; 3];

/// Error of every pixel between A and the reference B, which have the same size. A pixel that is NaN or infinite in
/// either is black in both, so that it does not spread.
#[must_use]
pub fn map(a: &HdrImage, b: &HdrImage, display_referred: bool) -> Vec<f64> {
    let size = Size { width: b.width as usize, height: b.height as usize };
    let exposure = if display_referred { None } else { Some(0.18 / mean_luminance(b)) };
    let finite = |pixel: &[f32; 3]| pixel.iter().all(|value| value.is_finite());
    let shown = |image: &HdrImage| {
        let pair = a.pixels.par_iter().zip(&b.pixels).map(|(a, b)| finite(a) && finite(b));
        let pixel = |(pixel, shown): (&[f32; 3], bool)| if shown { *pixel } else { [0.0; 3] };
        let shown = image.pixels.par_iter().zip(pair).map(pixel);
        shown.map(|pixel| opponent(displayed(pixel, exposure))).collect()
    };
    let [a, b] = [a, b].map(|image| Appearance::new(shown(image), size));
    let greatest = greatest_color_difference();
    let pixel = |i: usize| {
        let color = redistributed(color_difference(a.color[i], b.color[i]).powf(QC), greatest);
        let edge = (a.edges[i] - b.edges[i]).abs();
        let point = (a.points[i] - b.points[i]).abs();
        let feature = (edge.max(point) * std::f64::consts::FRAC_1_SQRT_2).powf(QF);
        color.powf((1.0 - feature).max(0.0))
    };
    (0..size.width * size.height).into_par_iter().map(pixel).collect()
}

/// Mean luminance of the finite pixels; 1 for black pictures.
fn mean_luminance(image: &HdrImage) -> f64 {
    let luminance = |pixel: &[f32; 3]| transform(&XYZ_FROM_RGB, pixel.map(f64::from))[1];
    let finite = || image.pixels.iter().map(luminance).filter(|y| y.is_finite());
    let mean = finite().sum::<f64>() / finite().count().max(1) as f64;
    if mean > 0.0 { mean } else { 1.0 }
}

/// The linear colour that a screen shows, in [0, 1].
fn displayed(pixel: [f32; 3], exposure: Option<f64>) -> Color {
    pixel.map(|value| {
        let value = f64::from(value).max(0.0);
        let shown = match exposure {
            None => value,
            Some(scale) => value * scale / (1.0 + value * scale),
        };
        shown.min(1.0)
    })
}

/// What the metric compares of one picture.
struct Appearance {
    /// Filtered by contrast sensitivity, in Hunt-adjusted CIELAB.
    color: Vec<Color>,
    /// Strength of edges.
    edges: Vec<f64>,
    /// Strength of points and thin lines.
    points: Vec<f64>,
}

impl Appearance {
    fn new(opponent: Vec<Color>, size: Size) -> Self {
        let channel = |c: usize| opponent.iter().map(|color| color[c]).collect::<Vec<_>>();
        let filtered = [0, 1, 2].map(|c| sensitivity_filtered(&channel(c), c, size));
        let seen = |i: usize| {
            let [y, x, z] = [filtered[0][i], filtered[1][i], filtered[2][i]];
            hunt(lab(linear_from_opponent([y, x, z]).map(|value| value.clamp(0.0, 1.0))))
        };
        let luminance: Vec<_> = opponent.iter().map(|c| (c[0] + 16.0) / 116.0).collect();
        let [edges, points] = features(&luminance, size);
        Self { color: (0..opponent.len()).into_par_iter().map(seen).collect(), edges, points }
    }
}

fn transform(matrix: &[[f64; 3]; 3], v: Color) -> Color {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Linear RGB to YCxCz, a linear relative of CIELAB.
fn opponent(rgb: Color) -> Color {
    let [x, y, z] = white_relative(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn linear_from_opponent([y, cx, cz]: Color) -> Color {
    let y = (y + 16.0) / 116.0;
    let xyz = [(y + cx / 500.0) * WHITE[0], y * WHITE[1], (y - cz / 200.0) * WHITE[2]];
    transform(&RGB_FROM_XYZ, xyz)
}

fn white_relative(rgb: Color) -> Color {
    let xyz = transform(&XYZ_FROM_RGB, rgb);
    [xyz[0] / WHITE[0], xyz[1] / WHITE[1], xyz[2] / WHITE[2]]
}

fn lab(rgb: Color) -> Color {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = white_relative(rgb)
        .map(|t| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Chroma looks weaker in the dark (Hunt's effect).
fn hunt([l, a, b]: Color) -> Color {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// HyAB distance: city block between lightness and chroma, Euclidean within chroma.
fn color_difference(p: Color, q: Color) -> f64 {
    (p[0] - q[0]).abs() + (p[1] - q[1]).hypot(p[2] - q[2])
}

/// Between green and blue, the farthest colours of sRGB.
fn greatest_color_difference() -> f64 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|color| hunt(lab(color)));
    color_difference(green, blue).powf(QC)
}

fn redistributed(difference: f64, greatest: f64) -> f64 {
    let knee = PC * greatest;
    if difference < knee {
        PT * difference / knee
    } else {
        PT + (1.0 - PT) * ((difference - knee) / (greatest - knee)).min(1.0)
    }
}

fn sensitivity_filtered(channel: &[f64], index: usize, size: Size) -> Vec<f64> {
    // The radius of the widest of all, so that borders act alike on every channel.
    let widest = 0.04;
    let radius = 3.0 * (widest / (2.0 * std::f64::consts::PI.powi(2))).sqrt() * PIXELS_PER_DEGREE;
    let radius = radius.ceil() as i32;
    let gaussian = |b: f64| {
        let rate = std::f64::consts::PI.powi(2) / (b * PIXELS_PER_DEGREE.powi(2));
        Kernel::new(radius, |x| (-rate * x * x).exp())
    };
    let mut sum = vec![0.0; channel.len()];
    let mut weight = 0.0;
    for (a, b) in SENSITIVITY[index].into_iter().filter(|(a, _)| *a > 0.0) {
        let kernel = gaussian(b);
        // The paper's weight times the sum of the two-dimensional kernel, which ours is divided by.
        let share = a * (std::f64::consts::PI / b).sqrt() * kernel.sum().powi(2);
        let kernel = kernel.scaled(1.0 / kernel.sum());
        let filtered = convolve(channel, &kernel, &kernel, size);
        sum.iter_mut().zip(filtered).for_each(|(sum, value)| *sum += share * value);
        weight += share;
    }
    sum.iter().map(|value| value / weight).collect()
}

/// Magnitudes of the gradients by first (edges) and second (points) derivatives of a Gaussian.
fn features(luminance: &[f64], size: Size) -> [Vec<f64>; 2] {
    let sigma = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as i32;
    let bell = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
    let smooth = Kernel::new(radius, bell);
    let smooth = smooth.scaled(1.0 / smooth.sum());
    let edge = Kernel::new(radius, |x| -x * bell(x)).balanced();
    let point = Kernel::new(radius, |x| (x * x / (sigma * sigma) - 1.0) * bell(x)).balanced();
    [edge, point].map(|detector| {
        let across = convolve(luminance, &detector, &smooth, size);
        let down = convolve(luminance, &smooth, &detector, size);
        across.iter().zip(down).map(|(x, y)| x.hypot(y)).collect()
    })
}
