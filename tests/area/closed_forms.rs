//! Polygons whose form factors are known: T1–T6, T14, T17, T18 of the list of hard cases in the project's notes.

use std::f64::consts::{PI, TAU};

use glam::Vec3;

use crate::common::gpu::CheckedGpu;
use crate::probe::{Outline, polygon, polygons};
use crate::truth;

/// Of a value of the order of 1.
const ABSOLUTE: f64 = 1e-6;

/// Facing down, from corner to corner.
fn rect(from: [f32; 2], to: [f32; 2], z: f32) -> Outline {
    let ([x0, y0], [x1, y1]) = (from, to);
    Outline::ring(&[[x0, y0, z], [x0, y1, z], [x1, y1, z], [x1, y0, z]])
}

/// 2 wide, 1 high, standing on the surface and facing the origin.
pub(crate) fn wall(d: f32) -> Outline {
    Outline::ring(&[[d, -1.0, 0.0], [d, -1.0, 1.0], [d, 1.0, 1.0], [d, 1.0, 0.0]])
}

/// Its form factor.
pub(crate) fn wall_form_factor(d: f64) -> f64 {
    let r = (1.0 + d * d).sqrt();
    ((1.0 / d).atan() - d / r * (1.0 / r).atan()) / PI
}

/// Regular, of circumradius 1 at height 1, facing down.
fn regular(n: u32, from: u32, to: u32) -> Outline {
    let vertex = |i: u32| {
        let angle = -TAU * f64::from(i) / f64::from(n);
        Vec3::new(angle.cos() as f32, angle.sin() as f32, 1.0)
    };
    let whole = from == 0 && to == n;
    let rim = (from..=if whole { n - 1 } else { to }).map(vertex);
    let ring = if whole { rim.collect() } else { rim.chain([Vec3::Z]).collect() };
    Outline { rings: vec![ring], ..Outline::default() }
}

fn expect(gpu: &CheckedGpu, what: &str, outline: &Outline, want: f64) {
    let got = polygon(gpu, outline);
    println!("{what}: {got:.9}, error {:.1e}", (got - want).abs());
    assert!((got - want).abs() <= ABSOLUTE, "{what}: {got}, want {want}");
}

#[test]
fn rectangles() {
    let gpu = CheckedGpu::open();
    expect(&gpu, "T1 corner above", &rect([0.0, 0.0], [1.0, 1.0], 1.0), 0.138_531_606);
    expect(&gpu, "T2 h = 1", &rect([-1.0, -1.0], [1.0, 1.0], 1.0), 0.554_126_424);
    expect(&gpu, "T2 h = 0.1", &rect([-1.0, -1.0], [1.0, 1.0], 0.1), 0.991_885_633);
    for h in [1e-4, 1e-6, 1e-7] {
        // 1 − h²/2 and so on, but for terms of h.
        expect(&gpu, "T2 h → 0", &rect([-1.0, -1.0], [1.0, 1.0], h), 1.0);
        let under_edge = truth::outline(&rect([0.0, -1.0], [2.0, 1.0], h));
        expect(&gpu, "T2 under the edge", &rect([0.0, -1.0], [2.0, 1.0], h), under_edge);
        assert!((under_edge - 0.5).abs() < 2.0 * f64::from(h));
        let under_corner = truth::outline(&rect([0.0, 0.0], [2.0, 2.0], h));
        expect(&gpu, "T2 under the corner", &rect([0.0, 0.0], [2.0, 2.0], h), under_corner);
        assert!((under_corner - 0.25).abs() < 2.0 * f64::from(h));
    }
    expect(&gpu, "T3 4 by 1", &rect([-2.0, -0.5], [2.0, 0.5], 2.0), 0.197_691_759);
    expect(&gpu, "T3 1 by 1", &rect([-0.5, -0.5], [0.5, 0.5], 1.0), 0.239_456_470);
    gpu.finish();
}

#[test]
fn wall_that_stands_on_the_surface() {
    let gpu = CheckedGpu::open();
    for (d, want) in [(1.0, 0.111_468_394), (1e-3, 0.499_431_690), (1e-5, 0.499_994_320)] {
        assert!((wall_form_factor(d) - want).abs() < 5e-9);
        expect(&gpu, "T4", &wall(d as f32), want);
    }
    for exponent in 0..=28 {
        let d = 10_f32.powf(-0.25 * exponent as f32);
        expect(&gpu, &format!("T4 at {d:e}"), &wall(d), wall_form_factor(f64::from(d)));
    }
    gpu.finish();
}

#[test]
fn polygons_of_every_scale() {
    let gpu = CheckedGpu::open();
    for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        let octant = Outline::ring(&[[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        expect(&gpu, "T5", &octant.map(|v| v * scale), 0.25);
    }
    let known = [(3, 0.281_455_694), (4, 0.384_900_179), (6, 0.451_816_018), (16, 0.493_524_937)];
    for (n, want) in known {
        expect(&gpu, &format!("T6 n = {n}"), &regular(n, 0, n), want);
    }
    let slices: Vec<_> = (0..8).map(|i| regular(64, 8 * i, 8 * i + 8)).collect();
    let sum: f64 = polygons(&gpu, &slices).iter().sum();
    println!("T6 n = 64, in eight slices: {sum:.9}");
    assert!((sum - 0.499_598_211).abs() <= ABSOLUTE, "{sum}");
    gpu.finish();
}

#[test]
fn sides_holes_and_concave_outlines() {
    let gpu = CheckedGpu::open();
    let (outer, inner) = (rect([-1.0, -1.0], [1.0, 1.0], 1.0), rect([-0.5, -0.5], [0.5, 0.5], 1.0));
    expect(&gpu, "T14 from behind", &outer.reversed(), -0.554_126_424);
    let rings = vec![outer.rings[0].clone(), inner.reversed().rings[0].clone()];
    let frame = Outline { rings, ..Outline::default() };
    expect(&gpu, "T18 ring", &frame, 0.554_126_424 - 0.239_456_470);
    let l_shape =
        [[0.0, 0.0], [0.0, 3.0], [1.0, 3.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]].map(|[x, y]| [x, y, 1.0]);
    let union = truth::outline(&rect([0.0, 0.0], [1.0, 3.0], 1.0))
        + truth::outline(&rect([1.0, 0.0], [2.0, 1.0], 1.0));
    expect(&gpu, "T18 L", &Outline::ring(&l_shape), union);
    // The same, tipped so that the horizon cuts them: up to four crossings of a ring.
    let tipped = |outline: &Outline| outline.map(|v| Vec3::new(v.x - 1.0, 1.0, v.y - 0.25));
    for (what, outline) in [("T18 L", &Outline::ring(&l_shape)), ("T18 ring", &frame)] {
        let outline = tipped(outline);
        expect(&gpu, &format!("{what} across the horizon"), &outline, truth::outline(&outline));
    }
    gpu.finish();
}

/// A ring may start anywhere: T15's first vertex below the horizon.
#[test]
fn the_first_vertex_does_not_matter() {
    let gpu = CheckedGpu::open();
    let comb = [
        [-2.0, -1.0],
        [-2.0, 1.0],
        [-1.0, 1.0],
        [-1.0, -0.5],
        [0.0, -0.5],
        [0.0, 2.0],
        [1.0, 2.0],
        [1.0, -0.25],
        [2.0, -0.25],
        [2.0, 1.0],
        [3.0, 1.0],
        [3.0, -1.0],
    ];
    for shift in 0..comb.len() {
        let mut turned = comb;
        turned.rotate_left(shift);
        let outline = Outline::ring(&turned.map(|[x, z]| [x, 1.0, z]));
        expect(&gpu, "comb", &outline, truth::outline(&outline));
    }
    gpu.finish();
}
