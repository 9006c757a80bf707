//! How much of a frame of gathered light is done at a time, so that input never waits for long.

/// Milliseconds that a slice may take in any case.
const LEAST: f64 = 10.0;
/// And the share of a frame of direct light.
const SHARE: f64 = 0.15;

/// What slices cost, as the last ones did.
#[derive(Debug, Default)]
pub(super) struct Pace {
    /// Milliseconds a row; 0 where it is not known.
    row: f64,
    /// What the first and the last slice of a frame cost besides.
    begin: f64,
    end: f64,
    /// Of the last slice.
    rows: u32,
}

/// A slice of a frame that has so many rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    pub(super) first: u32,
    pub(super) rows: u32,
    pub(super) of: u32,
}

impl Slice {
    pub(super) fn begins(self) -> bool {
        self.first == 0
    }

    pub(super) fn ends(self) -> bool {
        self.first + self.rows >= self.of
    }
}

impl Pace {
    /// The slice from row `first` on, while a frame of direct light takes so many milliseconds.
    pub(super) fn slice(&self, first: u32, of: u32, direct: f64) -> Slice {
        let budget = LEAST.max(SHARE * direct);
        let fits = |cost: f64| match self.row > 0.0 {
            true => ((budget - cost) / self.row).max(1.0) as u32,
            false => 1,
        };
        // Rows differ: no more than twice as many as were done before.
        let most = (2 * self.rows).max(1);
        let left = of - first;
        let begin = if first == 0 { self.begin } else { 0.0 };
        let rows = fits(begin).min(most);
        if rows < left {
            return Slice { first, rows, of };
        }
        // The last row waits where the frame's end has no room.
        let rows = if fits(begin + self.end) < left && left > 1 { left - 1 } else { left };
        Slice { first, rows, of }
    }

    /// A slice took so many milliseconds.
    pub(super) fn took(&mut self, slice: Slice, ms: f64) {
        let rows = f64::from(slice.rows);
        // What the frame's end cuts short is no measure.
        self.rows = if slice.ends() { self.rows.max(slice.rows) } else { slice.rows };
        match (slice.begins(), slice.ends()) {
            (true, true) => self.row = ms / rows,
            (true, false) => self.begin = (ms - rows * self.row).max(0.0),
            (false, true) => self.end = (ms - rows * self.row).max(0.0),
            (false, false) => self.row = ms / rows,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Longest slice and number of slices of the tenth frame, whose rows take so long.
    fn tenth(of: u32, [begin, row, end]: [f64; 3], direct: f64) -> (f64, u32) {
        let mut pace = Pace::default();
        let (mut longest, mut slices) = (0.0, 0);
        for _ in 0..10 {
            (longest, slices) = (0.0, 0);
            let mut first = 0;
            while first < of {
                let slice = pace.slice(first, of, direct);
                assert!(slice.rows > 0 && first + slice.rows <= of, "{slice:?}");
                let edges = if slice.begins() { begin } else { 0.0 } + if slice.ends() { end } else { 0.0 };
                let ms = edges + row * f64::from(slice.rows);
                pace.took(slice, ms);
                longest = f64::max(longest, ms);
                slices += 1;
                first += slice.rows;
            }
        }
        (longest, slices)
    }

    #[test]
    fn slices_take_what_they_may() {
        assert_eq!(tenth(45, [0.0, 1.0, 0.0], 50.0), (10.0, 5));
        assert_eq!(tenth(45, [0.0, 1.0, 0.0], 200.0), (30.0, 2));
        // Rows that take longer come one by one.
        assert_eq!(tenth(45, [0.0, 30.0, 0.0], 50.0), (30.0, 45));
        // The frame's end comes with its last row alone.
        assert_eq!(tenth(45, [5.0, 1.0, 14.0], 50.0), (15.0, 7));
        assert_eq!(tenth(1, [5.0, 1.0, 14.0], 50.0), (20.0, 1));
    }
}
