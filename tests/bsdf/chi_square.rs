//! Pearson's chi-square test of sampled directions against a density per solid angle, over cells of the whole sphere.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// Cells along the polar angle and along the azimuth.
const ROWS: usize = 40;
const COLUMNS: usize = 80;
/// Cells of fewer expected samples are pooled.
const LEAST_EXPECTED: f64 = 5.0;
/// Of one test, one-sided: 1e-3 over the 50 tests that the samplers undergo at most.
pub(crate) const SIGNIFICANCE: f64 = 2e-5;
/// Deviations of the normal distribution at that significance.
const CRITICAL: f64 = 4.107;
/// Nodes and weights of Gauss and Legendre's rule on [−1, 1], the positive half of ten.
const NODES: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_4),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Cells about an axis: even in azimuth, and along the angle γ from the axis even in u, where with q = sin²(γ/2)
/// u = q/(q + s²(1 − q)). s = 1 are even steps of cosγ; a small s crowds half of the cells within γ = 2s.
#[derive(Clone, Copy)]
pub(crate) struct Chart {
    axis: DVec3,
    s2: f64,
}

/// The outcome: deviations of the normal distribution, by Wilson and Hilferty's cube root, good to 1e-2 of them at the
/// degrees of freedom that [`Chart::test`] asks for.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub deviations: f64,
    pub freedom: usize,
    /// Of the density above the surface.
    pub integral: f64,
    /// Share of the samples above the surface.
    pub above: f64,
}

impl Outcome {
    pub(crate) fn accepted(&self) -> bool {
        self.deviations < CRITICAL
    }
}

impl Chart {
    /// Even steps of cosθ; the surface lies between two rows of cells.
    pub(crate) fn polar() -> Self {
        Self { axis: DVec3::Z, s2: 1.0 }
    }

    /// Around the mirror direction of `wo`, for a lobe about `width` wide.
    pub(crate) fn mirror(wo: DVec3, width: f64) -> Self {
        Self { axis: DVec3::new(-wo.x, -wo.y, wo.z), s2: width * width }
    }

    fn frame(&self) -> (DVec3, DVec3) {
        self.axis.any_orthonormal_pair()
    }

    fn cell(&self, wi: DVec3) -> usize {
        let (x, y) = self.frame();
        // 2 sin(γ/2) is a chord: 1 − cosγ would lose it.
        let q = (0.25 * (wi - self.axis).length_squared()).min(1.0);
        let u = q / (q + self.s2 * (1.0 - q));
        let turn = (wi.dot(y).atan2(wi.dot(x)) / TAU).rem_euclid(1.0);
        let row = ((u * ROWS as f64) as usize).min(ROWS - 1);
        row * COLUMNS + ((turn * COLUMNS as f64) as usize).min(COLUMNS - 1)
    }

    /// The direction at coordinates of [0, 1]², and dω per unit of them.
    fn place(&self, u: f64, turn: f64) -> (DVec3, f64) {
        let (x, y) = self.frame();
        let rest = 1.0 - u * (1.0 - self.s2);
        let q = (self.s2 * u / rest).min(1.0);
        let (sin, phi) = (2.0 * (q * (1.0 - q)).sqrt(), TAU * turn);
        let wi = (1.0 - 2.0 * q) * self.axis + sin * (x * phi.cos() + y * phi.sin());
        (wi, 4.0 * PI * self.s2 / (rest * rest))
    }

    /// ∫ pdf over a cell; `None` where the surface cuts it, and in the outermost row of a narrow chart, which is all the
    /// rest of the sphere.
    fn integral(&self, cell: usize, pdf: &impl Fn(DVec3) -> f64) -> Option<f64> {
        if self.s2 < 1.0 && cell / COLUMNS == ROWS - 1 {
            return None;
        }
        let signed = |(x, w): (f64, f64)| [(0.5 - 0.5 * x, 0.5 * w), (0.5 + 0.5 * x, 0.5 * w)];
        let nodes = || NODES.into_iter().flat_map(signed);
        let (row, column) = ((cell / COLUMNS) as f64, (cell % COLUMNS) as f64);
        let (mut sum, mut above, mut count) = (0.0, 0, 0);
        for (v, weight_v) in nodes() {
            for (u, weight_u) in nodes() {
                let (wi, solid) = self.place((row + u) / ROWS as f64, (column + v) / COLUMNS as f64);
                count += 1;
                if wi.z > 0.0 {
                    above += 1;
                    sum += weight_u * weight_v * solid * pdf(wi);
                }
            }
        }
        (above == 0 || above == count).then(|| sum / (ROWS * COLUMNS) as f64)
    }

    /// What is not integrated cell by cell, below the surface and cut by it, is one cell that holds the rest.
    pub(crate) fn test(&self, samples: impl Iterator<Item = DVec3>, pdf: impl Fn(DVec3) -> f64) -> Outcome {
        let expected: Vec<_> = (0..ROWS * COLUMNS).map(|cell| self.integral(cell, &pdf)).collect();
        let mut found = vec![0.0_f64; expected.len()];
        let (mut n, mut above) = (0.0, 0.0);
        for wi in samples {
            n += 1.0;
            let lit = wi.z > 0.0;
            above += f64::from(u32::from(lit));
            if lit {
                found[self.cell(wi)] += 1.0;
            }
        }
        let integral = expected.iter().flatten().sum::<f64>();
        let whole = expected.iter().zip(&found).filter_map(|(p, found)| Some((n * (*p)?, *found)));
        let (chi2, cells) = pearson(whole, n);
        let freedom = cells - 1;
        assert!(freedom >= 100, "{freedom} degrees of freedom test little");
        let k = freedom as f64;
        let deviations = ((chi2 / k).cbrt() - (1.0 - 2.0 / (9.0 * k))) / (2.0 / (9.0 * k)).sqrt();
        Outcome { deviations, freedom, integral, above: above / n }
    }
}

/// Σ (found − expected)²/expected over the cells, the small ones and the rest of the `n` pooled; and their number.
fn pearson(cells: impl Iterator<Item = (f64, f64)>, n: f64) -> (f64, usize) {
    let (mut chi2, mut count, mut pool, mut rest) = (0.0, 0, (0.0, 0.0), (n, n));
    let mut add = |expected: f64, found: f64| {
        chi2 += (found - expected) * (found - expected) / expected;
        count += 1;
    };
    for (expected, found) in cells {
        rest = (rest.0 - expected, rest.1 - found);
        if expected >= LEAST_EXPECTED {
            add(expected, found);
            continue;
        }
        pool = (pool.0 + expected, pool.1 + found);
        if pool.0 >= LEAST_EXPECTED {
            add(pool.0, pool.1);
            pool = (0.0, 0.0);
        }
    }
    let last = (pool.0 + rest.0, pool.1 + rest.1);
    if last.0 >= LEAST_EXPECTED {
        add(last.0, last.1);
    } else {
        // Nothing, up to quadrature: more than a few samples there are wrong.
        assert!(last.1 <= 30.0, "{} samples where {} are expected", last.1, last.0);
    }
    (chi2, count)
}
