//! BFGS for four variables, with backtracking.

use std::array::from_fn;

type Vector = [f64; 4];

const STEPS: usize = 120;
/// Relative decrease below which a step is the last, when two in a row are.
const DECREASE: f64 = 1e-7;
/// No variable moves farther than this in one step.
const STRIDE: f64 = 0.5;

fn dot(a: &Vector, b: &Vector) -> f64 {
    (0..4).map(|i| a[i] * b[i]).sum()
}

/// A minimum of `f`, which gives value and gradient, near `start`. Infinite values are walls; a variable whose gradient is
/// always zero stays.
pub(super) fn minimize(mut f: impl FnMut(&Vector) -> (f64, Vector), start: Vector) -> (f64, Vector) {
    let (mut x, (mut value, mut gradient)) = (start, f(&start));
    let mut inverse = identity(0.1);
    let mut small = 0;
    for step in 0..STEPS {
        let mut direction: Vector = from_fn(|i| -dot(&inverse[i], &gradient));
        if dot(&direction, &gradient) >= 0.0 {
            inverse = identity(0.1);
            direction = gradient.map(|g| -0.1 * g);
        }
        let longest = direction.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        if longest < 1e-12 {
            break;
        }
        let mut length = (STRIDE / longest).min(1.0);
        let slope = dot(&direction, &gradient);
        let mut next = None;
        for _ in 0..25 {
            let at: Vector = from_fn(|i| x[i] + length * direction[i]);
            let (new, new_gradient) = f(&at);
            if new <= value + 1e-4 * length * slope {
                next = Some((at, new, new_gradient));
                break;
            }
            length *= 0.4;
        }
        let Some((at, new, new_gradient)) = next else { break };
        let s: Vector = from_fn(|i| at[i] - x[i]);
        let y: Vector = from_fn(|i| new_gradient[i] - gradient[i]);
        update(&mut inverse, &s, &y, step == 0);
        small = if value - new < DECREASE * value { small + 1 } else { 0 };
        (x, value, gradient) = (at, new, new_gradient);
        if small == 2 {
            break;
        }
    }
    (value, x)
}

fn identity(scale: f64) -> [Vector; 4] {
    from_fn(|i| from_fn(|j| if i == j { scale } else { 0.0 }))
}

/// The BFGS update of the inverse Hessian; the first step also sets its scale.
fn update(inverse: &mut [Vector; 4], s: &Vector, y: &Vector, first: bool) {
    let sy = dot(s, y);
    if sy <= 1e-12 * (dot(s, s) * dot(y, y)).sqrt() || sy == 0.0 {
        return;
    }
    if first {
        *inverse = identity(sy / dot(y, y));
    }
    let hy: Vector = from_fn(|i| dot(&inverse[i], y));
    let yhy = dot(y, &hy);
    for i in 0..4 {
        for j in 0..4 {
            inverse[i][j] += (1.0 + yhy / sy) * s[i] * s[j] / sy - (hy[i] * s[j] + s[i] * hy[j]) / sy;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curved_valley() {
        let valley = |x: &Vector| {
            let [a, b, c, d] = *x;
            let (u, v) = (b - a * a, d - c * c);
            let value = 1.0 + 10.0 * (u * u + v * v) + (1.0 - a).powi(2) + (1.0 - c).powi(2);
            let first = |t: f64, p: f64| -40.0 * t * p - 2.0 * (1.0 - p);
            (value, [first(u, a), 20.0 * u, first(v, c), 20.0 * v])
        };
        let (value, at) = minimize(valley, [-1.0, 1.0, 0.0, 2.0]);
        assert!(value < 1.0 + 1e-6, "{value}");
        assert!(at.iter().all(|x| (x - 1.0).abs() < 1e-2), "{at:?}");
    }
}
