//! Rules of cubature with few points: of any rule with positive weights, as many points as there are moments suffice to
//! keep all moments (Tchakaloff 1957; Carathéodory).

use glam::DVec2;

/// A point and its weight.
pub(super) type Weighted = (DVec2, f64);

/// A subset of the points, reweighted, that integrates polynomials up to `degree` as all of them do; at most
/// (degree + 1)(degree + 2) / 2 points of [−1, 1]² are left.
pub(super) fn compress(mut points: Vec<Weighted>, degree: usize) -> Vec<Weighted> {
    let moments = (degree + 1) * (degree + 2) / 2;
    while points.len() > moments {
        let columns: Vec<_> = points[..=moments].iter().map(|&(p, _)| basis(p, degree)).collect();
        let direction = null_vector(columns);
        // Along it no moment changes: as far as the first weight vanishes.
        let steps = direction.iter().zip(&points).enumerate().filter(|(_, (d, _))| **d > 1e-12);
        let first = steps.map(|(i, (d, (_, w)))| (w / d, i)).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((step, gone)) = first else { break };
        for ((_, weight), d) in points.iter_mut().zip(&direction) {
            *weight -= step * d;
        }
        points.swap_remove(gone);
        points.retain(|(_, weight)| *weight > 0.0);
    }
    points
}

/// Products of Legendre polynomials up to a degree.
fn basis(p: DVec2, degree: usize) -> Vec<f64> {
    let legendre = |x: f64| {
        let mut values = vec![1.0, x];
        for n in 1..degree.max(1) {
            let k = n as f64;
            values.push(((2.0 * k + 1.0) * x * values[n] - k * values[n - 1]) / (k + 1.0));
        }
        values
    };
    let (s, t) = (legendre(p.x), legendre(p.y));
    (0..=degree).flat_map(|i| (0..=degree - i).map(|j| s[i] * t[j]).collect::<Vec<_>>()).collect()
}

/// A vector x ≠ 0 with Σ xᵢ columnᵢ = 0, of more columns than a column has rows: Gauss–Jordan elimination with full
/// pivoting. Its largest element is ±1.
fn null_vector(mut columns: Vec<Vec<f64>>) -> Vec<f64> {
    let (count, rows) = (columns.len(), columns[0].len());
    let mut order: Vec<usize> = (0..count).collect();
    let mut rank = 0;
    while rank < rows {
        let places = (rank..count).flat_map(|c| (rank..rows).map(move |r| (c, r)));
        let size = |&(c, r): &(usize, usize)| columns[c][r].abs();
        let Some(best) = places.max_by(|a, b| size(a).total_cmp(&size(b))).filter(|at| size(at) > 1e-13)
        else {
            break;
        };
        columns.swap(rank, best.0);
        order.swap(rank, best.0);
        columns.iter_mut().for_each(|column| column.swap(rank, best.1));
        let pivot = columns[rank].clone();
        for column in &mut columns[rank + 1..] {
            let scaled = column[rank] / pivot[rank];
            for row in (0..rows).filter(|&row| row != rank) {
                column[row] -= pivot[row] * scaled;
            }
            column[rank] = scaled;
        }
        rank += 1;
    }
    // The first column without a pivot is the sum of those with one, each times what stands in its row.
    let mut vector = vec![0.0; count];
    vector[order[rank]] = 1.0;
    (0..rank).for_each(|row| vector[order[row]] = -columns[rank][row]);
    let most = vector.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    vector.iter().map(|v| v / most).collect()
}
