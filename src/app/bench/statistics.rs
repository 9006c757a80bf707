//! Whether two sets of measurements differ: a bootstrap interval of the ratio of their medians.

use super::super::measure::median;
use serde::Serialize;

/// Confidence of the interval.
pub(super) const CONFIDENCE: f64 = 0.95;
/// The interval's ends then move by a hundredth of its width or so from seed to seed.
const RESAMPLES: usize = 4000;
const SEED: u64 = 7;
/// With fewer measurements not even all of them together span the median with [`CONFIDENCE`]: 1 − 2⁻⁴ is less.
const FEWEST: usize = 6;

/// Median of new measurements over that of old ones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Ratio {
    pub(super) ratio: f64,
    /// Ends of its interval.
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) verdict: Verdict,
}

/// What a ratio of times shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Verdict {
    Faster,
    Slower,
    Undecided,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Faster => "faster",
            Self::Slower => "slower",
            Self::Undecided => "undecided",
        })
    }
}

impl Ratio {
    /// Of times; `None` without measurements, or where an old time is 0.
    pub(super) fn of(new: &[f64], old: &[f64]) -> Option<Self> {
        let ratio = median(new)? / median(old)?;
        let mut random = Random(SEED);
        let mut ratios: Vec<f64> = (0..RESAMPLES)
            .filter_map(|_| Some(median(&random.resample(new))? / median(&random.resample(old))?))
            .collect();
        ratios.sort_by(f64::total_cmp);
        let tail = ((1.0 - CONFIDENCE) / 2.0 * RESAMPLES as f64) as usize;
        let (low, high) = (ratios[tail], ratios[RESAMPLES - 1 - tail]);
        let verdict = match () {
            () if new.len().min(old.len()) < FEWEST => Verdict::Undecided,
            () if low > 1.0 => Verdict::Slower,
            () if high < 1.0 => Verdict::Faster,
            () => Verdict::Undecided,
        };
        ratio.is_finite().then_some(Self { ratio, low, high, verdict })
    }
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// As many as there are, each any of them.
    fn resample(&mut self, values: &[f64]) -> Vec<f64> {
        // The upper half of a product is uniform below the number, but for 2⁻⁶⁴ of it.
        let mut any = || values[(u128::from(self.next()) * values.len() as u128 >> 64) as usize];
        (0..values.len()).map(|_| any()).collect()
    }
}
