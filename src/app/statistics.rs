//! Whether two sets of measurements differ: a bootstrap interval of the ratio of their medians.

use super::measure::median;
use serde::Serialize;

/// Confidence of the interval.
pub(super) const CONFIDENCE: f64 = 0.95;
/// Relative difference below which no point is faster or slower, however narrow the interval: it is made of one process's
/// frames, and knows nothing of what differs from process to process. Of the same program, started four times on a busy
/// machine, the medians over 15 points on lavapipe lay up to 2.7 % apart; of 90 comparisons of points, 6 had intervals
/// without 1, and 1 has one beyond this.
pub(super) const MARGIN: f64 = 0.02;
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
            () if low > 1.0 + MARGIN => Verdict::Slower,
            () if high < 1.0 / (1.0 + MARGIN) => Verdict::Faster,
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
        let mut any = || values[((u128::from(self.next()) * values.len() as u128) >> 64) as usize];
        (0..values.len()).map(|_| any()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of `ms` with log-normal noise of standard deviation `noise`, relative.
    fn frames(random: &mut Random, count: usize, ms: f64, noise: f64) -> Vec<f64> {
        let mut uniform = || (random.next() >> 11) as f64 / (1_u64 << 53) as f64;
        // Box and Muller.
        let mut normal =
            || (-2.0 * (1.0 - uniform()).ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
        (0..count).map(|_| ms * (noise * normal()).exp()).collect()
    }

    #[test]
    fn times_without_noise() {
        let certain = |ratio, verdict| Some(Ratio { ratio, low: ratio, high: ratio, verdict });
        assert_eq!(Ratio::of(&[2.0; 9], &[1.0; 7]), certain(2.0, Verdict::Slower));
        assert_eq!(Ratio::of(&[1.0; 9], &[2.0; 9]), certain(0.5, Verdict::Faster));
        assert_eq!(Ratio::of(&[3.0; 9], &[3.0; 9]), certain(1.0, Verdict::Undecided));
        assert_eq!(Ratio::of(&[2.0; 5], &[1.0; 99]), certain(2.0, Verdict::Undecided));
        assert_eq!(Ratio::of(&[], &[1.0]), None);
        assert_eq!(Ratio::of(&[1.0], &[0.0]), None);
    }

    /// The median of n resampled numbers is at most the k-th of them where at least (n + 1) / 2 of n draws, each with
    /// probability k / n, fall there: the interval's ends are known.
    #[test]
    fn ends_of_the_interval() {
        const N: i32 = 21;
        let choose = |k: i32| (0..k).map(|i| f64::from(N - i) / f64::from(i + 1)).product::<f64>();
        let below = |k: i32| {
            let p = f64::from(k) / f64::from(N);
            ((N + 1) / 2..=N).map(|hits| choose(hits) * p.powi(hits) * (1.0 - p).powi(N - hits)).sum::<f64>()
        };
        let end = |tail: f64| f64::from((1..=N).find(|&k| below(k) > tail).unwrap());
        let times: Vec<f64> = (1..=N).map(f64::from).collect();
        let Ratio { ratio, low, high, .. } = Ratio::of(&times, &[1.0; 9]).unwrap();
        assert_eq!([ratio, low, high], [11.0, end(0.025), end(0.975)]);
        // The other way round, ends and all, as the same numbers are drawn for whatever is resampled first.
        let Ratio { ratio, low, high, .. } = Ratio::of(&[1.0; 9], &times).unwrap();
        assert_eq!([ratio, low, high], [1.0 / 11.0, 1.0 / end(0.975), 1.0 / end(0.025)]);
    }

    /// The interval has the true ratio as often as it says, within three standard deviations of the binomial.
    #[test]
    fn coverage() {
        const TRIALS: u64 = 300;
        let covered = (0..TRIALS).filter(|seed| {
            let mut random = Random(seed << 32);
            let old = frames(&mut random, 20, 10.0, 0.05);
            let new = frames(&mut random, 20, 10.7, 0.05);
            let Ratio { low, high, .. } = Ratio::of(&new, &old).unwrap();
            (low..=high).contains(&1.07)
        });
        let (expected, covered) = (CONFIDENCE * TRIALS as f64, covered.count() as f64);
        let deviation = (expected * (1.0 - CONFIDENCE)).sqrt();
        assert!((covered - expected).abs() <= 3.0 * deviation, "{covered} of {TRIALS}");
    }

    /// At the noise of lavapipe on a busy machine, a median absolute deviation of 3 %, and as many frames as by default: the
    /// same is undecided and a tenth is found, each in 19 of 20 comparisons at least.
    #[test]
    fn verdicts() {
        const TRIALS: u64 = 200;
        // Of a normal distribution, over its median absolute deviation.
        const NOISE: f64 = 0.03 * 1.4826;
        for (slower, expected) in
            [(1.0, Verdict::Undecided), (1.1, Verdict::Slower), (1.0 / 1.1, Verdict::Faster)]
        {
            let right = (0..TRIALS).filter(|seed| {
                let mut random = Random((seed << 32) | 1);
                let old = frames(&mut random, 20, 10.0, NOISE);
                let new = frames(&mut random, 20, 10.0 * slower, NOISE);
                Ratio::of(&new, &old).unwrap().verdict == expected
            });
            let right = right.count() as u64;
            assert!(right * 20 >= 19 * TRIALS, "{slower}: {right} of {TRIALS} {expected}");
        }
    }
}
