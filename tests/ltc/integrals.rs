//! The tables themselves: densities that integrate to 1, matrices that do not fold, numbers without steps, the file.

use crate::{Random, tables};
use amas::ltc::{Basis, Frame, Layer, Lobe, Tables, density, leak};
use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// ∫ D over all directions, and over those below the surface, in polar angles about the basis' z.
fn integral(inverse: &DMat3, basis: &Basis) -> [f64; 2] {
    let (rings, sectors) = (4000, 400);
    let (mut all, mut below) = (0.0, 0.0);
    for ring in 0..rings {
        // tan(θ/2) = s tan ψ: dense where the lobe is.
        let psi = FRAC_PI_2 * (f64::from(ring) + 0.5) / f64::from(rings);
        let half = (0.5 * basis.stretch * psi.tan()).atan();
        let slope = 0.5 * basis.stretch / psi.cos().powi(2) * half.cos().powi(2) * 2.0;
        let (sin, cos) = (2.0 * half).sin_cos();
        for sector in 0..sectors {
            let phi = TAU * (f64::from(sector) + 0.5) / f64::from(sectors);
            let w = basis.axes.transpose() * DVec3::new(sin * phi.cos(), sin * phi.sin(), cos);
            let value = density(inverse, w) * slope * sin;
            all += value;
            below += if w.z < 0.0 { value } else { 0.0 };
        }
    }
    let cell = FRAC_PI_2 / f64::from(rings) * TAU / f64::from(sectors);
    [all * cell, below * cell]
}

#[test]
fn densities_integrate_to_one() {
    let mut random = Random(2);
    for layer in Layer::ALL {
        for _ in 0..3 {
            let parameters = random.parameters(layer, 84.0);
            let basis = Basis::new(layer.frame(), &Lobe::new(layer, parameters));
            let inverse = tables().layer(layer).lookup(parameters).inverse;
            let [all, below] = integral(&inverse, &basis);
            assert!((all - 1.0).abs() < 1e-3, "{layer:?} {parameters:?}: {all}");
            assert!((below - leak(&inverse)).abs() < 2e-3, "{layer:?} {parameters:?}: {below}");
        }
    }
}

#[test]
fn no_matrix_folds() {
    for layer in Layer::ALL {
        let table = tables().layer(layer);
        let [columns, rows] = layer.size();
        let steps = |texels: usize| (0..=4 * (texels - 1)).map(|step| step as f64 * 0.25);
        for row in steps(rows) {
            for column in steps(columns) {
                let parameters = layer.parameters(column, row);
                let [a, b, c, d] = table.shape_at(parameters);
                let t = Basis::new(layer.frame(), &Lobe::new(layer, parameters)).stretch;
                assert!(
                    a > 0.0 && d > 0.0 && a * d > t * t * b * c,
                    "{layer:?} {column} {row}: {a} {b} {c} {d}"
                );
            }
        }
    }
}

#[test]
fn numbers_fit_sixteen_bits() {
    for layer in Layer::ALL {
        let table = tables().layer(layer);
        assert_eq!(table.size.map(|side| side as usize), layer.size());
        assert_eq!(table.shape.len(), table.moments.len());
        for value in table.shape.as_flattened() {
            let code = f64::from(*value) / f64::from(table.scale) * 32_767.0;
            assert!(code.abs() <= 32_767.5 && (code - code.round()).abs() < 0.01, "{layer:?}: {code}");
        }
        let usual = match layer {
            Layer::Clearcoat => 20.0,
            Layer::Sheen => 5.0,
            _ => 1.3,
        };
        assert!(table.scale < usual, "{layer:?}: {}", table.scale);
        for moments in &table.moments {
            assert!(moments.iter().all(|value| (0.0..2.0).contains(value)), "{layer:?}: {moments:?}");
        }
    }
}

/// From one roughness to the next the albedo at normal incidence never rises, and bends by less than 0.5 %.
#[test]
fn albedo_has_no_steps() {
    for layer in [Layer::Metal, Layer::PrincipledSpecular] {
        let row: Vec<_> =
            tables().layer(layer).moments[..layer.size()[0]].iter().map(|moments| moments[0]).collect();
        for window in row.windows(3) {
            assert!(window[1] <= window[0] + 1e-6 && window[2] <= window[1] + 1e-6, "{layer:?} {window:?}");
            let bend = (window[0] - 2.0 * window[1] + window[2]).abs();
            assert!(bend < 0.005, "{layer:?} {window:?}");
        }
    }
}

/// As alpha goes to 0, a mirror: a = d = n·v.
#[test]
fn mirror_limit() {
    let table = tables().layer(Layer::Metal);
    assert_eq!(table.frame, Frame::Mirror);
    for degrees in [0.0, 30.0, 60.0, 80.0] {
        for r in [0.0, 1e-4, 0.01, 0.0316] {
            let cos = f64::to_radians(degrees).cos();
            let [a, b, _, d] = table.shape_at(amas::ltc::Parameters { r, cos });
            let off = [(a - cos) / cos, b / cos, (d - cos) / cos];
            assert!(off.iter().all(|off| off.abs() < 0.01), "{degrees}° r {r}: {off:?}");
        }
    }
}

#[test]
fn lookups_outside_are_those_at_the_rim() {
    for (r, cos) in [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)] {
        let outside = tables().lookup(Layer::Metal, 3.0 * r - 1.0, 3.0 * cos - 1.0);
        let rim = tables().lookup(Layer::Metal, r, cos);
        assert_eq!(outside.moments, rim.moments, "r {r} cos {cos}");
        assert!(outside.inverse.is_finite());
    }
}

#[test]
fn damaged_files() {
    let mut bytes = Vec::new();
    tables().write(&mut bytes).unwrap();
    assert_eq!(Tables::read(&bytes).as_ref(), Some(tables()));
    assert!(bytes.len() < 300_000, "{}", bytes.len());
    assert_eq!(Tables::read(&[]), None);
    assert_eq!(Tables::read(&bytes[..bytes.len() - 1]), None);
    for place in [0, 7, 8, 1000, bytes.len() - 1] {
        let mut damaged = bytes.clone();
        damaged[place] ^= 1;
        assert_eq!(Tables::read(&damaged), None, "{place}");
    }
}
