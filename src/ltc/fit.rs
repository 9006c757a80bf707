//! One texel: the transformed cosine nearest to a lobe.

use std::f64::consts::FRAC_1_PI;

use super::matrix::Shape;
use super::minimize::minimize;
use super::samples::Samples;
use super::{Basis, Frame, Layer, Lobe, Parameters};

/// What a fit minimises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// Total variation, the bound on the error under any light.
    L1,
    /// Mean square, which keeps the height and the place of the peak better.
    L2,
}

/// Directions over which a fit is judged while it runs.
const SAMPLES: usize = 8000;
/// Rounds off the absolute value, as a fraction of a sample's mean share.
const SMOOTH: f64 = 0.004;

/// Coordinates of the search, all of the order of 1: ln(a/a₀), b/a, c/d, ln(d/d₀).
pub(super) type Point = [f64; 4];

/// The search for one texel.
pub(super) struct Fit {
    /// x, y, z, weight and weight × lobe / mass of each direction.
    samples: Vec<[f64; 5]>,
    basis: Basis,
    /// The normal's x and z in the basis.
    normal: [f64; 2],
    /// a₀ and d₀.
    scale: [f64; 2],
    objective: Objective,
    /// ∫ (lobe / mass)².
    square: f64,
    /// At normal incidence the lobe is the same at every azimuth, and so is its fit.
    round: bool,
}

impl Fit {
    pub(super) fn new(layer: Layer, parameters: Parameters, objective: Objective) -> Self {
        let lobe = Lobe::new(layer, parameters);
        let basis = Basis::new(layer.frame(), &lobe);
        let samples = Samples::new(&lobe, &basis, SAMPLES);
        let mass = samples.mass();
        let rows = samples.directions.iter().zip(&samples.weights).zip(&samples.lobe);
        let samples: Vec<_> =
            rows.map(|((p, weight), value)| [p.x, p.y, p.z, *weight, weight * value / mass]).collect();
        let square = samples.iter().map(|[.., weight, share]| share * share / weight).sum();
        // The lobe across the plane of incidence is narrower by this, seen from the side.
        let narrow = match layer.frame() {
            Frame::Mirror => lobe.wo.z.max(lobe.alpha),
            Frame::Normal => 1.0,
        };
        Self {
            samples,
            normal: [basis.axes.z_axis.x, basis.axes.z_axis.z],
            basis,
            scale: [narrow, narrow],
            objective,
            square,
            round: parameters.cos >= 1.0 || layer == Layer::SubstrateDiffuse,
        }
    }

    pub(super) fn shape(&self, point: &Point) -> Shape {
        let (a, d) = (self.scale[0] * point[0].exp(), self.scale[1] * point[3].exp());
        [a, point[1] * a, point[2] * d, d]
    }

    /// The point of `shape`, clear of the logarithms' poles.
    pub(super) fn point(&self, shape: Shape) -> Point {
        let [a, b, c, d] = shape;
        let (a, d) = (a.max(1e-6), d.max(1e-6));
        [(a / self.scale[0]).ln(), b / a, c / d, (d / self.scale[1]).ln()]
    }

    /// The nearest minimum to `start`, with its loss.
    pub(super) fn descend(&self, start: Point) -> (f64, Point) {
        let start = if self.round { [0.0, 0.0, 0.0, start[3]] } else { start };
        minimize(|point| self.loss(point), start)
    }

    /// The objective and its gradient along the search's coordinates.
    pub(super) fn loss(&self, point: &Point) -> (f64, Point) {
        let shape = self.shape(point);
        let (value, slopes) = self.loss_of(shape);
        let slopes = self.chain(shape, slopes);
        (value, if self.round { [0.0, 0.0, 0.0, slopes[3]] } else { slopes })
    }

    /// The objective and its slopes along the four numbers.
    pub(super) fn loss_of(&self, shape: Shape) -> (f64, Shape) {
        let t = self.basis.stretch;
        let [a, b, c, d] = [shape[0], t * shape[1], t * shape[2], t * shape[3]];
        let det = a * d - b * c;
        if det <= 0.0 || !det.is_finite() {
            return (f64::INFINITY, [0.0; 4]);
        }
        let round_off = SMOOTH / self.samples.len() as f64;
        let mut sum = 0.0;
        let (mut slopes, mut stretch) = ([0.0; 4], 0.0);
        for &[x, y, z, weight, share] in &self.samples {
            let (qx, qz) = (a * x + b * z, c * x + d * z);
            let q2 = qx * qx + y * y + qz * qz;
            let over = weight * FRAC_1_PI * det / (q2 * q2);
            let ours = over * qz.max(0.0);
            let difference = ours - share;
            let slope = match self.objective {
                Objective::L1 => {
                    let size = (difference * difference + round_off * round_off).sqrt();
                    sum += size - round_off;
                    difference / size
                }
                Objective::L2 => {
                    sum += difference * difference / weight;
                    2.0 * difference / weight
                }
            };
            if qz <= 0.0 {
                continue;
            }
            // ∂/∂(a, b, c, d); by way of the determinant after the loop.
            stretch += slope * ours;
            let pull = slope * ours * 4.0 / q2;
            let lift = slope * over;
            slopes[0] -= pull * qx * x;
            slopes[1] -= pull * qx * z;
            slopes[2] += lift * x - pull * qz * x;
            slopes[3] += lift * z - pull * qz * z;
        }
        let mut gradient = [
            slopes[0] + stretch * d / det,
            slopes[1] - stretch * c / det,
            slopes[2] - stretch * b / det,
            slopes[3] + stretch * a / det,
        ];
        let value = match self.objective {
            Objective::L1 => {
                let (leak, slopes) = self.leak([a, b, c, d]);
                for (gradient, slope) in gradient.iter_mut().zip(slopes) {
                    *gradient = 0.5 * (*gradient + slope);
                }
                0.5 * (sum + leak)
            }
            Objective::L2 => {
                gradient = gradient.map(|g| g / self.square);
                sum / self.square
            }
        };
        (value, [gradient[0], t * gradient[1], t * gradient[2], t * gradient[3]])
    }
    /// The share below the surface, which no sample sees, and its slopes.
    fn leak(&self, [a, b, c, d]: Shape) -> (f64, Point) {
        let [nx, nz] = self.normal;
        let (x, z) = (d * nx - c * nz, a * nz - b * nx);
        let length = x.hypot(z);
        let (by_x, by_z) = (0.5 * x * z / length.powi(3), -0.5 * x * x / length.powi(3));
        (0.5 * (1.0 - z / length), [by_z * nz, -by_z * nx, -by_x * nz, by_x * nx])
    }

    /// From the slopes along the four numbers to those along the search's coordinates.
    pub(super) fn chain(&self, [a, b, c, d]: Shape, slopes: Shape) -> Point {
        [slopes[0] * a + slopes[1] * b, slopes[1] * a, slopes[2] * d, slopes[2] * c + slopes[3] * d]
    }
}
