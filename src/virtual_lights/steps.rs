//! Choices in proportion to weights.

/// Weights by their running sums: a density in steps over [0, 1).
#[derive(Clone, Debug)]
pub(super) struct Steps {
    upper: Vec<f64>,
}

/// What a number in [0, 1) chose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pick {
    pub(super) index: usize,
    /// Where in its step the number lay, in [0, 1): a uniform number again.
    pub(super) within: f64,
    pub(super) probability: f64,
}

impl Steps {
    pub(super) fn new(weights: impl Iterator<Item = f64>) -> Self {
        let mut sum = 0.0;
        let add = |weight: f64| {
            sum += weight;
            sum
        };
        Self { upper: weights.map(add).collect() }
    }

    /// Sum of all weights.
    pub(super) fn total(&self) -> f64 {
        self.upper.last().copied().unwrap_or(0.0)
    }

    /// `None` where all weights are 0.
    pub(super) fn pick(&self, xi: f64) -> Option<Pick> {
        let at = xi * self.total();
        let index = self.upper.partition_point(|&upper| upper <= at);
        let below = if index == 0 { 0.0 } else { self.upper[index - 1] };
        let width = self.upper.get(index)? - below;
        let within = ((at - below) / width).min(1.0 - f64::EPSILON);
        Some(Pick { index, within, probability: width / self.total() })
    }
}
