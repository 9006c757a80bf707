//! Separable convolution in double precision.

use rayon::prelude::*;

/// Weights at −radius … radius.
pub(super) struct Kernel(Vec<f64>);

impl Kernel {
    pub(super) fn new(radius: i32, weight: impl Fn(f64) -> f64) -> Self {
        Self((-radius..=radius).map(|x| weight(f64::from(x))).collect())
    }

    pub(super) fn sum(&self) -> f64 {
        self.0.iter().sum()
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self(self.0.iter().map(|weight| weight * factor).collect())
    }

    /// Positive weights sum to 1, negative ones to −1.
    pub(super) fn balanced(&self) -> Self {
        let total = |sign: f64| self.0.iter().map(|w| (sign * w).max(0.0)).sum::<f64>();
        let (up, down) = (total(1.0), total(-1.0));
        Self(self.0.iter().map(|w| if *w > 0.0 { w / up } else { w / down }).collect())
    }
}

/// Pixels across and down.
#[derive(Clone, Copy)]
pub(super) struct Size {
    pub(super) width: usize,
    pub(super) height: usize,
}

/// Separable convolution; beyond the border lies the border's pixel.
pub(super) fn convolve(source: &[f64], across: &Kernel, down: &Kernel, size: Size) -> Vec<f64> {
    let Size { width, height } = size;
    let clamped =
        |i: usize, k: usize, radius: usize, count: usize| (i + k).saturating_sub(radius).min(count - 1);
    let pass = |kernel: &Kernel, pick: &(dyn Fn(usize, usize) -> f64 + Sync)| {
        let sum = |i: usize| kernel.0.iter().enumerate().map(|(k, weight)| weight * pick(i, k)).sum::<f64>();
        (0..width * height).into_par_iter().map(sum).collect::<Vec<_>>()
    };
    let radius = across.0.len() / 2;
    let rows = pass(across, &|i, k| source[i / width * width + clamped(i % width, k, radius, width)]);
    let radius = down.0.len() / 2;
    pass(down, &|i, k| rows[clamped(i / width, k, radius, height) * width + i % width])
}
