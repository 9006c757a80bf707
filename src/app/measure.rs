//! Figures from repeated measurements.

use serde::Serialize;

/// Bytes, as memory is told.
pub(super) const MEGABYTE: f64 = 1024.0 * 1024.0;

/// Median, median absolute deviation, least and number of measurements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Figure {
    pub(super) median: f64,
    pub(super) mad: f64,
    pub(super) min: f64,
    pub(super) n: usize,
}

impl Figure {
    /// `None` without measurements.
    pub(super) fn of(values: &[f64]) -> Option<Self> {
        let median = median(values)?;
        let deviations: Vec<f64> = values.iter().map(|value| (value - median).abs()).collect();
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        Some(Self { median, mad: self::median(&deviations)?, min, n: values.len() })
    }
}

/// `None` without measurements.
pub(super) fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let upper = sorted.len() / 2;
    let lower = sorted.len().checked_sub(1)? / 2;
    Some((sorted[lower] + sorted[upper]) / 2.0)
}

/// Largest resident set of the process so far, bytes; `None` where the system does not tell.
pub(super) fn peak_host_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_deviation() {
        assert_eq!(Figure::of(&[]), None);
        assert_eq!(
            Figure::of(&[3.0, 1.0, 2.0, 100.0]),
            Some(Figure { median: 2.5, mad: 1.0, min: 1.0, n: 4 })
        );
    }
}
